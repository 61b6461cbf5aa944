//! The report as one self-contained page: the tables, and the figures inline.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::table::{Cell, Table};

/// A figure as the page shows it.
pub(crate) struct Picture {
    /// Stem of its file names.
    pub(crate) name: String,
    /// Its SVG document.
    pub(crate) svg: String,
}

const STYLE: &str = include_str!("style.css");

/// The page.
pub(crate) fn page(
    heading: &str,
    warnings: &[String],
    tables: &[Table],
    pictures: &[Picture],
) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "rotor report" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "Parametric instability of a cracked rotor with an asymmetric disk" }
                p.heading { (heading) }
                @for warning in warnings {
                    p.warning role="note" { strong { "Warning: " } (warning) }
                }
                @for table in tables { (section(table)) }
                h2 { "Figures" }
                @for picture in pictures { (figure(picture)) }
                footer { "Written by rotor " (env!("CARGO_PKG_VERSION")) }
            }
        }
    }
    .into_string()
}

fn section(table: &Table) -> Markup {
    html! {
        section {
            h2 { (table.title) }
            @if !table.rows.is_empty() {
                div.scroll {
                    table {
                        @if table.headings.iter().any(|heading| !heading.is_empty()) {
                            thead { tr {
                                @for (column, heading) in table.headings.iter().enumerate() {
                                    th.number[table.is_numeric(column)] scope="col" { (symbol(heading)) }
                                }
                            } }
                        }
                        tbody {
                            @for row in &table.rows { tr { @for item in row { (cell(item)) } } }
                        }
                    }
                }
            }
            @for note in &table.notes { p.note { (note) } }
        }
    }
}

fn cell(cell: &Cell) -> Markup {
    html! {
        @match cell {
            Cell::Text(text) => td { (text) },
            Cell::Number(number) => td.number { (number) },
            Cell::Symbol(name) => td { (symbol(name)) },
        }
    }
}

/// A symbol with its subscripts: `l_d/L` has the d low.
fn symbol(text: &str) -> Markup {
    let mut parts = text.split('_');
    let first = parts.next().unwrap_or_default();
    html! {
        (with_low_digits(first))
        @for part in parts {
            @let end = part.find(['/', ' ']).unwrap_or(part.len());
            @let (low, rest) = part.split_at(end);
            sub { (low) } (rest)
        }
    }
}

/// Digits that are letters of their own, `ε₁₂`, as the subscripts that all others are.
fn with_low_digits(text: &str) -> Markup {
    const LOW: std::ops::RangeInclusive<char> = '₀'..='₉';
    let start = text
        .find(|letter| LOW.contains(&letter))
        .unwrap_or(text.len());
    let (symbol, low) = text.split_at(start);
    let digits: String = low
        .chars()
        .filter_map(|letter| char::from_digit(u32::from(letter).checked_sub(0x2080)?, 10))
        .collect();
    html! { (symbol) @if !digits.is_empty() { sub { (digits) } } }
}

fn figure(picture: &Picture) -> Markup {
    html! {
        figure {
            (PreEscaped(inline(&picture.svg)))
            figcaption {
                a href={ (picture.name) ".svg" } { "SVG" } " · "
                a href={ (picture.name) ".png" } { "PNG" } " · "
                a href={ (picture.name) ".csv" } { "data" }
            }
        }
    }
}

/// An SVG document without its XML declaration, which a page must not have inside.
fn inline(svg: &str) -> &str {
    svg.find("<svg")
        .map_or(svg, |start| svg.get(start..).unwrap_or(svg))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn subscripts_end_where_the_symbol_ends() {
        assert_eq!(symbol("l_d/L").into_string(), "l<sub>d</sub>/L");
        assert_eq!(symbol("× ω_st").into_string(), "× ω<sub>st</sub>");
        assert_eq!(symbol("β").into_string(), "β");
        assert_eq!(symbol("ε₁₂").into_string(), "ε<sub>12</sub>");
    }

    #[test]
    fn what_a_file_is_called_cannot_write_into_the_page() {
        let page = page("Rotor: <script>.toml", &[], &[], &[]);
        assert!(page.contains("&lt;script&gt;"));
        assert!(!page.contains("<script"));
    }
}
