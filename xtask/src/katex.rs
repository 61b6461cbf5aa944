//! KaTeX beside the documentation, which shows formulas with it: `docs/katex/header.html` says how a page finds it there.

use std::fs;
use std::path::{Path, PathBuf};

use crate::Outcome;

/// Where KaTeX lies in this repository.
const FOLDER: &str = "docs/katex";

/// The programs; they are copied as they are.
const PROGRAMS: [&str; 2] = ["katex.min.js", "contrib/auto-render.min.js"];

/// The style, which names the fonts.
const STYLE: &str = "katex.min.css";

/// What stands before the name of each font in the style.
const FONT: &str = "src:url(fonts/";

/// What stands in the head of every page.
pub(crate) fn header(root: &Path) -> PathBuf {
    root.join(FOLDER).join("header.html")
}

/// Copies KaTeX to the folder of the documentation.
///
/// The style has the fonts in itself: Firefox lets a page from the disk load styles of other folders, but no fonts.
pub(crate) fn copy(root: &Path) -> Outcome {
    let from = root.join(FOLDER);
    let to = crate::peers::target(root).join("doc").join("katex");
    let style = fs::read_to_string(from.join(STYLE)).map_err(|error| failed(STYLE, &error))?;
    let style = with_fonts(&style, |name| {
        let file = format!("fonts/{name}.woff2");
        fs::read(from.join(&file)).map_err(|error| failed(&file, &error))
    })?;
    let programs = to.join("contrib");
    fs::create_dir_all(&programs)
        .and_then(|()| fs::write(to.join(STYLE), style))
        .map_err(|error| format!("{}: {error}", to.display()))?;
    for program in PROGRAMS {
        fs::copy(from.join(program), to.join(program)).map_err(|error| failed(program, &error))?;
    }
    Ok(())
}

fn failed(name: &str, error: &std::io::Error) -> String {
    format!("{FOLDER}/{name} cannot be copied: {error}")
}

/// The style with the bytes of each font in the place of its addresses.
fn with_fonts(
    style: &str,
    font: impl Fn(&str) -> Result<Vec<u8>, String>,
) -> Result<String, String> {
    let mut parts = style.split(FONT);
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        // NAME.woff2) format("woff2") and the addresses of older formats up to the brace.
        let named = part.split_once(".woff2)");
        let (name, rest) = named.ok_or_else(|| format!("{STYLE}: a font is not in WOFF2"))?;
        let end = rest.find('}').unwrap_or(rest.len());
        text.push_str("src:url(data:font/woff2;base64,");
        text.push_str(&base64(&font(name)?));
        text.push_str(") format(\"woff2\")");
        text.push_str(&rest[end..]);
    }
    Ok(text)
}

/// The bytes in the alphabet of RFC 4648, six bits a letter.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for group in bytes.chunks(3) {
        let bits = (0..3).fold(0_u32, |bits, i| {
            bits << 8 | u32::from(group.get(i).copied().unwrap_or_default())
        });
        for letter in 0..4 {
            text.push(if letter <= group.len() {
                char::from(LETTERS[(bits >> (18 - 6 * letter)) as usize & 63])
            } else {
                '='
            });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_written_as_rfc_4648_has_them() {
        let examples = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ];
        for (bytes, text) in examples {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
        assert_eq!(base64(&[251, 255]), "+/8=");
    }

    #[test]
    fn a_font_stands_in_the_place_of_its_addresses() {
        let style = "@font-face{a:b;src:url(fonts/A.woff2) format(\"woff2\"),url(fonts/A.ttf) format(\"truetype\")}.c{d:e}";
        assert_eq!(
            with_fonts(style, |name| Ok(name.as_bytes().to_vec())).unwrap(),
            "@font-face{a:b;src:url(data:font/woff2;base64,QQ==) format(\"woff2\")}.c{d:e}"
        );
    }

    #[test]
    fn the_server_has_the_version_that_lies_here() {
        let folder = crate::root().join(FOLDER);
        let style = fs::read_to_string(folder.join(STYLE)).unwrap();
        let version = style.split(".katex-version:after{content:\"").nth(1);
        let version = version.and_then(|rest| rest.split('"').next()).unwrap();
        let header = fs::read_to_string(folder.join("header.html")).unwrap();
        assert!(
            header.contains(&format!("npm/katex@{version}/")),
            "{version}"
        );
    }

    #[test]
    fn every_library_has_the_header_for_docs_rs() {
        let root = crate::root();
        let header = fs::read_to_string(header(&root)).unwrap();
        for library in [
            "codegen",
            "lanes",
            "rotor-core",
            "rotor-macros",
            "rotor-plot",
        ] {
            let folder = root.join(library);
            let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
            let arguments = "rustdoc-args = [\"--html-in-header\", \"katex-header.html\"]";
            assert!(manifest.contains(arguments), "{library}");
            let linked = fs::read_to_string(folder.join("katex-header.html")).unwrap();
            assert!(linked == header, "{library}");
        }
    }

    #[test]
    fn every_font_of_the_style_is_in_the_folder() {
        let root = crate::root();
        let style = fs::read_to_string(root.join(FOLDER).join(STYLE)).unwrap();
        let file = |name: &str| {
            root.join(FOLDER)
                .join("fonts")
                .join(format!("{name}.woff2"))
        };
        let text = with_fonts(&style, |name| {
            fs::read(file(name)).map_err(|_| name.to_owned())
        });
        assert!(!text.unwrap().contains("url(fonts/"));
    }
}
