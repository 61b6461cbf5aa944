//! Line breaks as rustfmt makes them, where those of prettyplease differ.
//!
//! Both break lists that are too long for their line, at another width. The statements of generated code are short enough
//! to stand on one line for both.

/// The longest line.
const LINE: usize = 100;
/// The widest list of elements or arguments on one line.
const LIST: usize = 60;
/// The widest list of a struct's fields on one line.
const FIELDS: usize = 18;
/// The widest choice on one line.
const CHOICE: usize = 50;
/// Arrays of elements no wider than this fill their lines.
const SHORT: usize = 10;

/// Formatted items with the line breaks of rustfmt.
pub(super) fn as_rustfmt(text: &str) -> String {
    let mut output = String::with_capacity(text.len());
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if is_open_signature(line) {
            let rest: Vec<&str> = lines
                .by_ref()
                .take_while_inclusive(|line| !line.trim_start().starts_with(')'))
                .collect();
            signature(line, &rest, &mut output);
        } else if line.trim_start().starts_with("let [") {
            let rest = if line.ends_with(';') {
                None
            } else {
                Some(
                    lines
                        .by_ref()
                        .take_while_inclusive(|line| !line.ends_with(';')),
                )
            };
            let words: Vec<&str> = std::iter::once(line.trim())
                .chain(rest.into_iter().flatten().map(str::trim))
                .collect();
            pattern(
                line.len() - line.trim_start().len(),
                &words.join(" "),
                &mut output,
            );
        } else if line.trim_start().starts_with("let ") && line.ends_with(" = [") {
            let rest = block(line, &mut lines);
            let elements: Vec<&str> = rest.into_iter().map(str::trim).collect();
            let (end, elements) = elements.split_last().unwrap_or((&"];", &[]));
            let elements = elements.join(" ");
            broken(
                &format!("{line}{}{end}", elements.trim_end_matches(',')),
                &mut output,
            );
        } else if line.trim_start().starts_with("let ") && line.ends_with('(') {
            call(line, &block(line, &mut lines), &mut output);
        } else if let Some(value) = open_binding(line) {
            let rest: Vec<&str> = lines
                .by_ref()
                .take_while_inclusive(|line| !line.ends_with(';'))
                .collect();
            binding(line, value, &rest, &mut output);
        } else if line.trim_start().strip_suffix(" {").is_some_and(is_path) {
            fields(line, &block(line, &mut lines), &mut output);
        } else if let Some(lines) = choice(line) {
            lines.iter().for_each(|line| push(line, &mut output));
        } else {
            broken(line, &mut output);
        }
    }
    output
}

/// The lines that belong to one that is open, its end included.
fn block<'t>(line: &str, lines: &mut std::str::Lines<'t>) -> Vec<&'t str> {
    lines
        .by_ref()
        .take_while_inclusive(|inner| indent_of(inner) > indent_of(line))
        .collect()
}

/// A binding of `if a { x } else { y }` over the lines that it takes where it is wide.
fn choice(line: &str) -> Option<[String; 5]> {
    let (binding, choice) = line.split_once(" = if ")?;
    let (condition, branches) = choice.strip_suffix(" };")?.split_once(" { ")?;
    let (first, second) = branches.split_once(" } else { ")?;
    // Without the semicolon and the `if `.
    let wide = choice.len() - 1 + 3 > CHOICE;
    let outer = &line[..line.len() - line.trim_start().len()];
    wide.then(|| {
        [
            format!("{binding} = if {condition} {{"),
            format!("{outer}    {first}"),
            format!("{outer}}} else {{"),
            format!("{outer}    {second}"),
            format!("{outer}}};"),
        ]
    })
}

/// The first part of a value that goes on on further lines.
fn open_binding(line: &str) -> Option<&str> {
    let (_, value) = line.trim_start().strip_prefix("let ")?.split_once(" = ")?;
    let closed = line.ends_with([';', '{', '(', '[', ',']);
    (!closed).then_some(value)
}

/// A sum or product on one line, or on a line of its own behind the binding, if it fits; it was broken for a narrower line.
fn binding(line: &str, value: &str, rest: &[&str], output: &mut String) {
    let words: Vec<&str> = std::iter::once(value)
        .chain(rest.iter().map(|line| line.trim()))
        .collect();
    let value_on_one = words.join(" ");
    let head = line.strip_suffix(value).unwrap_or(line);
    let below = format!("{}    {value_on_one}", " ".repeat(indent_of(line)));
    if head.chars().count() + value_on_one.chars().count() <= LINE {
        push(&format!("{head}{value_on_one}"), output);
    } else if below.chars().count() <= LINE {
        push(head.trim_end(), output);
        push(&below, output);
    } else {
        push(line, output);
        rest.iter().for_each(|line| push(line, output));
    }
}

/// A call's arguments on its own line, if they fit.
fn call(line: &str, rest: &[&str], output: &mut String) {
    let words: Vec<&str> = rest.iter().map(|line| line.trim()).collect();
    let (end, arguments) = words
        .split_last()
        .map_or(("", &[][..]), |(end, inner)| (*end, inner));
    let arguments = arguments.join(" ");
    let on_one = format!("{line}{}{end}", arguments.trim_end_matches(','));
    if on_one.chars().count() <= LINE {
        push(&on_one, output);
    } else {
        push(line, output);
        rest.iter().for_each(|line| push(line, output));
    }
}

/// A struct's fields on one line where they are short.
fn fields(head: &str, rest: &[&str], output: &mut String) {
    let (end, inner) = rest
        .split_last()
        .map_or(("", rest), |(end, inner)| (*end, inner));
    let joined: Vec<&str> = inner.iter().map(|line| line.trim()).collect();
    let joined = joined.join(" ");
    let joined = joined.trim_end_matches(',');
    if joined.chars().count() <= FIELDS {
        push(&format!("{head} {joined} {}", end.trim_start()), output);
    } else {
        push(head, output);
        output.push_str(&as_rustfmt(&rest.join("\n")));
    }
}

fn indent_of(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

trait TakeWhileInclusive<'a>: Iterator<Item = &'a str> {
    /// The items up to and with the first one that is refused.
    fn take_while_inclusive(self, keep: impl Fn(&str) -> bool) -> impl Iterator<Item = &'a str>;
}

impl<'a, I: Iterator<Item = &'a str>> TakeWhileInclusive<'a> for I {
    fn take_while_inclusive(
        mut self,
        keep: impl Fn(&str) -> bool,
    ) -> impl Iterator<Item = &'a str> {
        let mut ended = false;
        std::iter::from_fn(move || {
            let item = if ended { None } else { self.next() }?;
            ended = !keep(item);
            Some(item)
        })
    }
}

fn is_open_signature(line: &str) -> bool {
    let line = line.trim_start();
    (line.starts_with("pub fn ") || line.starts_with("fn ")) && line.ends_with('(')
}

/// A function's head on one line, if it fits.
fn signature(head: &str, rest: &[&str], output: &mut String) {
    let (end, parameters) = rest
        .split_last()
        .map_or(("", rest), |(end, parameters)| (*end, parameters));
    let parameters: Vec<&str> = parameters.iter().map(|line| line.trim()).collect();
    let joined = format!(
        "{head}{}{}",
        parameters.join(" ").trim_end_matches(','),
        end.trim_start()
    );
    if joined.chars().count() <= LINE {
        push(&joined, output);
    } else {
        push(head, output);
        rest.iter().for_each(|line| push(line, output));
    }
}

/// A binding of an array's elements to names, each on a line of its own where they are many.
fn pattern(indent: usize, statement: &str, output: &mut String) {
    let outer = " ".repeat(indent);
    let list = statement
        .strip_prefix("let [")
        .and_then(|rest| rest.split_once("] = "))
        .filter(|(list, _)| list.len() > LIST);
    let Some((list, value)) = list else {
        return push(&format!("{outer}{statement}"), output);
    };
    push(&format!("{outer}let ["), output);
    split(list)
        .iter()
        .for_each(|name| push(&format!("{outer}    {name},"), output));
    push(&format!("{outer}] = {value}"), output);
}

fn push(line: &str, output: &mut String) {
    output.push_str(line);
    output.push('\n');
}

/// A line; a list that it ends with stands on several lines where it is wide.
fn broken(line: &str, output: &mut String) {
    let Some(List {
        before,
        opening,
        items,
        after,
    }) = List::at_end_of(line)
    else {
        return push(line, output);
    };
    let widths: usize = items
        .iter()
        .map(|item| item.chars().count() + 2)
        .sum::<usize>()
        .saturating_sub(2);
    let most = if opening == "{" { FIELDS } else { LIST };
    if widths <= most {
        return push(line, output);
    }
    let indent = line.len() - line.trim_start().len();
    let closing = match opening {
        "{" => "}",
        "[" => "]",
        _ => ")",
    };
    push(&format!("{before}{opening}"), output);
    let inner = " ".repeat(indent + 4);
    if opening == "[" && items.iter().all(|item| item.chars().count() <= SHORT) {
        filled(&items, &inner, output);
    } else {
        items
            .iter()
            .for_each(|item| broken(&format!("{inner}{item},"), output));
    }
    push(&format!("{}{closing}{after}", " ".repeat(indent)), output);
}

/// As many items on each line as fit.
fn filled(items: &[&str], indent: &str, output: &mut String) {
    let mut line = indent.to_owned();
    for item in items {
        let separator = if line.len() > indent.len() { " " } else { "" };
        if line.chars().count() + separator.len() + item.chars().count() + 1 > LINE {
            push(&std::mem::replace(&mut line, indent.to_owned()), output);
            line = format!("{line}{item},");
        } else {
            line = format!("{line}{separator}{item},");
        }
    }
    push(&line, output);
}

/// A list in brackets at the end of a line.
struct List<'t> {
    before: &'t str,
    opening: &'static str,
    items: Vec<&'t str>,
    after: &'t str,
}

impl<'t> List<'t> {
    fn at_end_of(line: &'t str) -> Option<Self> {
        if line.trim_start().starts_with("//") || line.trim_start().starts_with('#') {
            return None;
        }
        let code = line.trim_end_matches([';', ',']);
        let start = opening_of_last(code)?;
        let (before, list) = code.split_at(start);
        let opening = match list.chars().next()? {
            '(' => "(",
            '[' => "[",
            _ => "{",
        };
        // A value by itself, or that of a binding or field; no call, index or block.
        let head = before.trim_start();
        let alone = head.is_empty()
            || head.ends_with(": ")
            || (head.starts_with("let ") && head.ends_with("= "));
        let named = opening == "{" && head.ends_with(' ') && is_path(head.trim_end());
        if !(alone && opening != "{" || named) {
            return None;
        }
        let items = split(list[1..list.len() - 1].trim());
        Some(Self {
            before,
            opening,
            items,
            after: &line[code.len()..],
        })
    }
}

fn is_path(text: &str) -> bool {
    text.chars()
        .all(|c| c.is_alphanumeric() || matches!(c, '_' | ':'))
        && text.contains(char::is_uppercase)
}

/// Where the bracket opens that closes at the end of the text.
fn opening_of_last(text: &str) -> Option<usize> {
    let mut depth = 0_usize;
    for (position, c) in text.char_indices().rev() {
        match c {
            ')' | ']' | '}' => depth += 1,
            '(' | '[' | '{' => {
                depth = depth.checked_sub(1)?;
                if depth == 0 {
                    return Some(position);
                }
            }
            _ if depth == 0 => return None,
            _ => {}
        }
    }
    None
}

/// The items between the commas of a list.
fn split(list: &str) -> Vec<&str> {
    let (mut items, mut depth, mut start) = (Vec::new(), 0_usize, 0);
    for (position, c) in list.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                items.push(list[start..position].trim());
                start = position + 1;
            }
            _ => {}
        }
    }
    items.push(list[start..].trim());
    items.retain(|item| !item.is_empty());
    items
}
