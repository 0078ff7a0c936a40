//! A page: title, contents, sections of text, tables and figures.

use crate::Figure;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use trilith_model::visible;

pub(crate) const STYLE: &str = "
:root { color-scheme: light; }
body { font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fff; max-width: 1180px;
  margin: 0 auto; padding: 1.5rem; }
h1 { font-size: 1.7rem; margin: 0 0 .5rem; } h2 { font-size: 1.2rem; margin: 2.2rem 0 .4rem; }
nav ol { columns: 3 18rem; column-gap: 1.5rem; font-size: .85rem; padding: 0; list-style: none; }
nav li { break-inside: avoid; overflow-wrap: anywhere; padding-left: 1rem; text-indent: -1rem; }
nav a { color: #24527a; text-decoration: none; } nav a:hover { text-decoration: underline; }
.figures { display: flex; flex-wrap: wrap; gap: 1rem; }
figure { margin: 0; flex: 1 1 460px; max-width: 640px; border: 1px solid #ddd; border-radius: 6px;
  padding: .4rem; }
figure svg { width: 100%; height: auto; display: block; }
figcaption { font-size: .85rem; color: #444; padding: .2rem .5rem; }
table { border-collapse: collapse; font-size: .82rem; margin: .6rem 0; }
td, th { padding: .2rem .6rem; border-bottom: 1px solid #e4e4e4; text-align: left;
  font-variant-numeric: tabular-nums; }
th { background: #f4f4f4; } .wide { overflow-x: auto; }
pre { background: #f6f7f8; border: 1px solid #e4e6e8; border-radius: 6px; padding: .6rem .8rem;
  font: .85rem/1.45 ui-monospace, 'DejaVu Sans Mono', monospace; overflow-x: auto; margin: .6rem 0; }
code { font: .92em ui-monospace, 'DejaVu Sans Mono', monospace; }
nav li.group { padding: .5rem 0 .1rem; text-indent: 0; font-weight: 600; break-after: avoid; }
.pass { color: #14692a; } .fail { color: #b3151b; font-weight: 700; }
.note { color: #555; font-size: .9rem; }
@media print { body { max-width: none; padding: 0; } section, figure, tr { break-inside: avoid; }
  section { break-inside: auto; } nav { display: none; } }
";

/// A part of a section.
#[derive(Clone, Debug)]
pub enum Block {
    /// A paragraph.
    Text(String),
    /// A paragraph in small print: a source, a remark.
    Note(String),
    /// Lines shown as they are: an equation, a piece of a file.
    Code(String),
    /// A table with a row of heads. A cell `pass` or `FAIL` is coloured.
    Table {
        /// Heads of the columns.
        head: Vec<String>,
        /// Rows.
        rows: Vec<Vec<String>>,
    },
    /// Figures side by side.
    Figures(Vec<Figure>),
}

impl Block {
    /// A paragraph.
    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    /// A paragraph in small print.
    pub fn note(text: impl Into<String>) -> Self {
        Self::Note(text.into())
    }

    /// Lines shown as they are.
    pub fn code(text: impl Into<String>) -> Self {
        Self::Code(text.into())
    }

    fn markup(&self) -> Markup {
        html! {
            @match self {
                Self::Text(text) => p { (words(text)) },
                Self::Note(text) => p.note { (words(text)) },
                Self::Code(text) => pre { (text) },
                Self::Table { head, rows } => div.wide { table {
                    thead { tr { @for cell in head { th { (cell) } } } }
                    tbody { @for row in rows { tr { @for cell in row {
                        td class=[verdict(cell)] { (words(cell)) }
                    } } } }
                } },
                Self::Figures(all) => div.figures { @for f in all {
                    figure {
                        (PreEscaped(f.svg()))
                        @if !f.caption.is_empty() { figcaption { (f.caption) } }
                    }
                } },
            }
        }
    }
}

impl From<Figure> for Block {
    fn from(figure: Figure) -> Self {
        Self::Figures(vec![figure])
    }
}

impl From<Vec<Figure>> for Block {
    fn from(figures: Vec<Figure>) -> Self {
        Self::Figures(figures)
    }
}

/// A text with what stands between backticks as code.
fn words(text: &str) -> Markup {
    let parts: Vec<&str> = text.split('`').collect();
    if parts.len().is_multiple_of(2) {
        return html! { (text) };
    }
    html! { @for (i, part) in parts.iter().enumerate() {
        @if i % 2 == 1 { code { (part) } } @else { (part) }
    } }
}

fn verdict(cell: &str) -> Option<&'static str> {
    match cell {
        "pass" => Some("pass"),
        "FAIL" => Some("fail"),
        _ => None,
    }
}

/// A section with a place in the contents.
#[derive(Clone, Debug)]
pub struct Section {
    id: String,
    title: String,
    group: String,
    blocks: Vec<Block>,
}

impl Section {
    /// An empty section. The id names its place in the page.
    pub fn new(id: impl Into<String>, title: impl Into<String>) -> Self {
        Self { id: id.into(), title: title.into(), group: String::new(), blocks: Vec::new() }
    }

    /// Puts it under a head of the contents, with the sections of the same group beside it.
    #[must_use]
    pub fn group(mut self, head: impl Into<String>) -> Self {
        self.group = head.into();
        self
    }

    /// Adds a part.
    #[must_use]
    pub fn block(mut self, block: impl Into<Block>) -> Self {
        self.blocks.push(block.into());
        self
    }
}

/// A page.
#[derive(Clone, Debug)]
pub struct Page {
    title: String,
    lead: Vec<Block>,
    sections: Vec<Section>,
}

impl Page {
    /// An empty page.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), lead: Vec::new(), sections: Vec::new() }
    }

    /// Adds a part before the contents.
    #[must_use]
    pub fn lead(mut self, block: impl Into<Block>) -> Self {
        self.lead.push(block.into());
        self
    }

    /// Adds a section.
    #[must_use]
    pub fn section(mut self, section: Section) -> Self {
        self.sections.push(section);
        self
    }

    /// The page as one HTML document: no script, no font and no picture from elsewhere. Control characters of texts are
    /// written out.
    #[must_use]
    pub fn html(&self) -> String {
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    title { (self.title) }
                    style { (PreEscaped(STYLE)) }
                }
                body {
                    h1 { (self.title) }
                    @for block in &self.lead { (block.markup()) }
                    @if self.sections.len() > 1 {
                        nav { ol { @for (i, s) in self.sections.iter().enumerate() {
                            @if !s.group.is_empty() && (i == 0 || self.sections[i - 1].group != s.group) {
                                li.group { (s.group) }
                            }
                            li { a href={ "#" (s.id) } { (s.title) } }
                        } } }
                    }
                    @for s in &self.sections {
                        section id=(s.id) {
                            h2 { (s.title) }
                            @for block in &s.blocks { (block.markup()) }
                        }
                    }
                }
            }
        }
        .into_string();
        visible(&page).into_owned()
    }
}
