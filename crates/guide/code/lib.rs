//! The guide: a book in plain Markdown, the reference that is written from the schema, and what its tests
//! need to run every example.
//!
//! The pages are in `src`, in the order of `SUMMARY.md`; mdBook makes a site of them. The blocks of Rust in
//! them are compiled and run as documentation tests of [`rust`].

mod gallery;
mod page;
mod reference;

pub use gallery::{Exhibit, exhibits, gallery};
pub use page::{Fence, Measured, Page, Table, pages};
pub use reference::{reference, study_reference};

/// The pages with Rust in them.
pub mod rust {
    #[doc = include_str!("../src/from_rust.md")]
    pub mod from_rust {}
    #[allow(rustdoc::invalid_codeblock_attributes, reason = "marks for the tests of the guide")]
    #[doc = include_str!("../src/reduction.md")]
    pub mod reduction {}
}
