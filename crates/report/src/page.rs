//! A page: title, contents, sections of text, tables and figures.

use crate::chart::Scales;
use crate::{Entries, Figure, chart};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use trilith_model::visible;

pub(crate) const STYLE: &str = concat!(include_str!("page.css"), include_str!("chart/chart.css"));

/// Contents of more sections than this show the heads of their groups, and the sections on a click.
const FOLDED: usize = 60;

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
    /// A box to tick: whether figures with a common [scale](Figure::scale) have it; seen where any have.
    Scales(String),
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

    fn markup(&self, fine: f64, scales: &Scales) -> Markup {
        html! {
            @match self {
                Self::Text(text) => p { (words(text)) },
                Self::Note(text) => p.note { (words(text)) },
                Self::Code(text) => pre { (text) },
                Self::Table { head, rows } => div.wide { table {
                    thead { tr { @for cell in head { @if cell.is_empty() { td {} } @else { th { (cell) } } } } }
                    tbody { @for row in rows { tr { @for cell in row {
                        td class=[look(cell)] { (words(cell)) }
                    } } } }
                } },
                Self::Figures(all) => div.figures { @for f in all { (chart::figure(f, fine, scales)) } },
                Self::Scales(words) => label.scales { input type="checkbox" checked data-scales=""; " " (words) },
            }
        }
    }

    fn figures(&self) -> &[Figure] {
        if let Self::Figures(all) = self { all } else { &[] }
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
pub(crate) fn words(text: &str) -> Markup {
    let parts: Vec<&str> = text.split('`').collect();
    if parts.len().is_multiple_of(2) {
        return html! { (text) };
    }
    html! { @for (i, part) in parts.iter().enumerate() {
        @if i % 2 == 1 { code { (part) } } @else { (part) }
    } }
}

/// Longest cell of a table that stays in one line, letters: a number and its unit are one thing.
const ONE_LINE: usize = 24;

fn look(cell: &str) -> Option<&'static str> {
    match cell {
        "pass" => Some("pass"),
        "FAIL" => Some("fail"),
        _ => (cell.chars().count() > ONE_LINE).then_some("long"),
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

/// Charts for a page of another making, which computes: they have no still pictures, and a cursor that asks the page for
/// the run where it is (event `asked` of the document, with `set` and `row`).
#[derive(Clone, Debug)]
pub struct Charts {
    /// The figures, each as an element.
    pub figures: String,
    /// Data and script, to stand behind them.
    pub script: String,
    /// The style of charts; it takes its colours from `--paper`, `--ink`, `--soft` and `--line`.
    pub style: &'static str,
}

impl Charts {
    /// Of figures and of what their points stand for.
    #[must_use]
    pub fn new(figures: &[Figure], entries: &Entries) -> Self {
        let fine = chart::fine(figures.iter().map(chart::size).sum());
        let figures = html! { @for f in figures { (chart::alive(f, fine)) } };
        let script = html! {
            (chart::json("", Some("entries"), &chart::legible(entries.data())))
            (chart::script(&[chart::ASK]))
        };
        let [figures, script] =
            [figures, script].map(|part| visible(&part.into_string()).into_owned());
        Self { figures, script, style: include_str!("chart/chart.css") }
    }
}

/// A page.
#[derive(Clone, Debug)]
pub struct Page {
    title: String,
    lead: Vec<Block>,
    sections: Vec<Section>,
    entries: Option<Entries>,
}

impl Page {
    /// An empty page.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), lead: Vec::new(), sections: Vec::new(), entries: None }
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

    /// Says what points of figures stand for: [`Figure::standing_for`] names rows of this.
    #[must_use]
    pub fn entries(mut self, entries: Entries) -> Self {
        self.entries = Some(entries);
        self
    }

    /// Where the sections are, under the heads of their groups; folded beneath them where they are many.
    fn contents(&self) -> Markup {
        let folded = self.sections.len() > FOLDED;
        let groups = self.sections.chunk_by(|a, b| a.group == b.group);
        let entry = |s: &Section| html! { li { a href={ "#" (s.id) } { (s.title) } } };
        html! {
            @if folded && self.sections.iter().all(|s| !s.group.is_empty()) {
                @for group in groups {
                    details {
                        summary { (group[0].group) " (" (group.len()) ")" }
                        ol { @for s in group { (entry(s)) } }
                    }
                }
            } @else {
                ol { @for group in groups {
                    @if !group[0].group.is_empty() { li.group { (group[0].group) } }
                    @for s in group { (entry(s)) }
                } }
            }
        }
    }

    /// The page as one HTML document: no script, no font and no picture from elsewhere. Figures can be read, zoomed and
    /// switched where scripts run, and are still pictures elsewhere and on paper. Control characters of texts are
    /// written out.
    #[must_use]
    pub fn html(&self) -> String {
        let all = || self.lead.iter().chain(self.sections.iter().flat_map(|s| &s.blocks));
        let points: usize = all().flat_map(Block::figures).map(chart::size).sum();
        let fine = chart::fine(points);
        // What scrolls is reached by keys where a script has looked.
        let scripted = points > 0 || all().any(|b| matches!(b, Block::Table { .. }));
        let scales = &Scales::of(all().flat_map(Block::figures));
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    title { (self.title) }
                    style { (PreEscaped(STYLE)) }
                    link rel="icon" href="data:,";
                }
                body {
                    main {
                        h1 { (self.title) }
                        @for block in &self.lead { (block.markup(fine, scales)) }
                        @if self.sections.len() > 1 {
                            nav aria-label="Contents" { (self.contents()) }
                        }
                        @for s in &self.sections {
                            section id=(s.id) {
                                h2 { (s.title) }
                                @for block in &s.blocks { (block.markup(fine, scales)) }
                            }
                        }
                    }
                    @if let Some(entries) = &self.entries { (chart::json("", Some("entries"), &chart::legible(entries.data()))) }
                    @if scripted { (chart::script(&[])) }
                }
            }
        }
        .into_string();
        visible(&page).into_owned()
    }
}
