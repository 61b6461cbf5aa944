//! PNG and PDF from an SVG document, with the letters of the embedded fonts.

use std::sync::{Arc, LazyLock};

use resvg::tiny_skia::{Pixmap, PremultipliedColorU8, Transform};
use resvg::usvg::fontdb::{Database, FaceInfo, ID, Language, Source, Stretch, Style, Weight};
use resvg::usvg::{self, Options, Tree, WriteOptions};
use svg2pdf::{ConversionOptions, PageOptions};

use crate::PlotErrorKind;
use crate::label::{FAMILY, FONT_FILES};

/// Pixels of the PNG image per unit of the SVG document: sharp on screens of today.
const MAGNIFICATION: f32 = 2.0;
/// Units of an SVG document in an inch of paper, as CSS has it.
const UNITS_PER_INCH: f32 = 96.0;

/// The embedded fonts and no other. Their names and styles are stated here, because the font files, cut down to the letters
/// that figures need, have none.
static FONTS: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let looks = [
        (Style::Normal, Weight::NORMAL),
        (Style::Oblique, Weight::NORMAL),
        (Style::Normal, Weight::BOLD),
    ];
    let mut fonts = Database::new();
    for (data, (style, weight)) in FONT_FILES.into_iter().zip(looks) {
        fonts.push_face_info(FaceInfo {
            id: ID::dummy(),
            source: Source::Binary(Arc::new(data)),
            index: 0,
            families: vec![(FAMILY.to_owned(), Language::English_UnitedStates)],
            post_script_name: FAMILY.to_owned(),
            style,
            weight,
            stretch: Stretch::Normal,
            monospaced: false,
        });
    }
    Arc::new(fonts)
});

/// Reads an SVG document.
fn tree(svg: &str) -> Result<Tree, usvg::Error> {
    Tree::from_str(
        svg,
        &Options {
            fontdb: Arc::clone(&FONTS),
            ..Options::default()
        },
    )
}

/// Draws an SVG document as pixels.
pub(crate) fn png(svg: &str) -> Result<Vec<u8>, PlotErrorKind> {
    let tree = tree(svg).map_err(|error| PlotErrorKind::Png(error.to_string()))?;
    let size = tree.size().to_int_size().scale_by(MAGNIFICATION);
    let mut pixels = size
        .and_then(|size| Pixmap::new(size.width(), size.height()))
        .ok_or_else(|| PlotErrorKind::Png("the image is too large".to_owned()))?;
    let magnified = Transform::from_scale(MAGNIFICATION, MAGNIFICATION);
    resvg::render(&tree, magnified, &mut pixels.as_mut());
    encoded(&pixels).map_err(|error| PlotErrorKind::Png(error.to_string()))
}

/// Encodes pixels without transparency, as every page is white.
fn encoded(pixels: &Pixmap) -> Result<Vec<u8>, png::EncodingError> {
    let colours = |pixel: &PremultipliedColorU8| [pixel.red(), pixel.green(), pixel.blue()];
    let colours: Vec<u8> = pixels.pixels().iter().flat_map(colours).collect();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, pixels.width(), pixels.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::Best);
    // Filters help with photographs; files of drawings grow by a sixth with them.
    encoder.set_filter(png::FilterType::NoFilter);
    encoder.write_header()?.write_image_data(&colours)?;
    Ok(file)
}

/// Converts an SVG document to PDF. Letters become outlines first: embedding fonts would take crates that are several
/// times as long to build as all others that draw.
pub(crate) fn pdf(svg: &str) -> Result<Vec<u8>, PlotErrorKind> {
    let failed = |error: usvg::Error| PlotErrorKind::Pdf(error.to_string());
    let live = tree(svg).map_err(failed)?;
    let outlined = live.to_string(&WriteOptions {
        preserve_text: false,
        ..WriteOptions::default()
    });
    let tree = tree(&outlined).map_err(failed)?;
    svg2pdf::to_pdf(
        &tree,
        ConversionOptions::default(),
        PageOptions {
            dpi: UNITS_PER_INCH,
        },
    )
    .map_err(|error| PlotErrorKind::Pdf(error.to_string()))
}
