//! Figures as PNG, for word processors that take no SVG.

#[cfg(feature = "png")]
mod raster;

/// Why there is no PNG of a figure.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PngError {
    /// This build cannot write PNG.
    #[error("this build of the program writes no PNG: it was made without the feature `png`")]
    NotBuiltIn,
    /// A figure without width or height, or larger than there is room for.
    #[error("a picture of {0} by {1} pixels cannot be drawn")]
    Size(u32, u32),
    /// The drawing is not what the library for it understands.
    #[error("the figure cannot be turned into pixels: {0}")]
    Drawing(String),
}

/// An SVG of so many pixels as PNG of twice as many each way.
#[cfg(feature = "png")]
pub(crate) fn png(svg: &str, size: (u32, u32)) -> Result<Vec<u8>, PngError> {
    raster::png(svg, size)
}

#[cfg(not(feature = "png"))]
pub(crate) fn png(_: &str, _: (u32, u32)) -> Result<Vec<u8>, PngError> {
    Err(PngError::NotBuiltIn)
}

/// True where this build can write PNG.
#[must_use]
pub const fn png_is_built_in() -> bool {
    cfg!(feature = "png")
}
