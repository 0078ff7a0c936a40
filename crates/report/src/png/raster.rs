//! An SVG drawn into pixels by resvg.
//!
//! The letters are DejaVu Sans, built in, never those of the machine: a machine without fonts draws the same, to
//! the byte.

use super::PngError;
use resvg::{tiny_skia, usvg};
use std::sync::{Arc, OnceLock};

/// Pixels of a PNG for one of the figure, so that it stays sharp on paper: 192 to the inch.
const SCALE: u32 = 2;
/// Pixels of an SVG in an inch.
const PER_INCH: f64 = 96.0;
const INCH: f64 = 0.0254;

/// The condensed faces: as wide as the letters that browsers take for `sans-serif`, which figures are laid out for.
fn fonts() -> &'static (Arc<usvg::fontdb::Database>, String) {
    static FONTS: OnceLock<(Arc<usvg::fontdb::Database>, String)> = OnceLock::new();
    FONTS.get_or_init(|| {
        let mut fonts = usvg::fontdb::Database::new();
        for face in [dejavu::sans_condensed::regular(), dejavu::sans_condensed::bold()] {
            fonts.load_font_source(usvg::fontdb::Source::Binary(Arc::new(face)));
        }
        let family = fonts.faces().next().and_then(|f| f.families.first());
        let family = family.map_or_else(String::new, |f| f.0.clone());
        fonts.set_sans_serif_family(family.clone());
        (Arc::new(fonts), family)
    })
}

pub(super) fn png(svg: &str, (width, height): (u32, u32)) -> Result<Vec<u8>, PngError> {
    let (fonts, family) = fonts();
    let options = usvg::Options {
        fontdb: Arc::clone(fonts),
        font_family: family.clone(),
        ..usvg::Options::default()
    };
    let failed = |e: &dyn std::fmt::Display| PngError::Drawing(e.to_string());
    let tree = usvg::Tree::from_str(svg, &options).map_err(|e| failed(&e))?;
    let size = || PngError::Size(width.saturating_mul(SCALE), height.saturating_mul(SCALE));
    let (w, h) = match (width.checked_mul(SCALE), height.checked_mul(SCALE)) {
        (Some(w), Some(h)) => (w, h),
        _ => return Err(size()),
    };
    let mut pixels = tiny_skia::Pixmap::new(w, h).ok_or_else(size)?;
    // Paper is white, and so the picture needs no transparency.
    pixels.fill(tiny_skia::Color::WHITE);
    let scale = tiny_skia::Transform::from_scale(SCALE as f32, SCALE as f32);
    resvg::render(&tree, scale, &mut pixels.as_mut());
    let opaque: Vec<u8> =
        pixels.pixels().iter().flat_map(|p| [p.red(), p.green(), p.blue()]).collect();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, w, h);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let per_metre = (f64::from(SCALE) * PER_INCH / INCH).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header().map_err(|e| failed(&e))?;
    writer.write_image_data(&opaque).map_err(|e| failed(&e))?;
    writer.finish().map_err(|e| failed(&e))?;
    Ok(file)
}
