//! A page of the book, taken apart into what its tests check.
//!
//! | in the page | meaning |
//! |---|---|
//! | block `ron,file=NAME` | a whole model; commands of the page find it as NAME |
//! | block `ron,in=GROUP` | a fragment: entries of that section of a model |
//! | block `ron,study-in=GROUP` | the same of a study |
//! | block `rust,ignore,from=FILE` | a piece of the source in FILE |
//! | block `console` | lines `$ trilith …` are run; the lines below must be in what they print, `…` stands for anything |
//! | `<!-- trilith run …: KEY UNIT -->` | the number before it is that of the summary |
//! | `<!-- table: run … {1} … ; KEY UNIT ; - -->` | the same for the columns of the table below, `{1}` being the text of the first |

use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag, TagEnd};
use std::path::Path;

/// A page.
#[derive(Debug)]
pub struct Page {
    /// Name of the file.
    pub name: String,
    /// Its text.
    pub text: String,
    /// Blocks of code.
    pub fences: Vec<Fence>,
    /// Words in backticks outside blocks.
    pub words: Vec<String>,
    /// Numbers that a run must give.
    pub measured: Vec<Measured>,
    /// Tables of such numbers.
    pub tables: Vec<Table>,
    /// Where links and pictures lead.
    pub links: Vec<String>,
}

/// A block of code.
#[derive(Debug)]
pub struct Fence {
    /// Language and attributes.
    pub info: String,
    /// What it holds.
    pub text: String,
}

impl Fence {
    /// The value of an attribute behind the language.
    #[must_use]
    pub fn attribute(&self, name: &str) -> Option<&str> {
        self.info.split(',').find_map(|part| part.strip_prefix(name)?.strip_prefix('='))
    }

    /// The language.
    #[must_use]
    pub fn language(&self) -> &str {
        self.info.split(',').next().unwrap_or_default()
    }
}

/// A number of the text.
#[derive(Debug)]
pub struct Measured {
    /// The number as it is written.
    pub shown: String,
    /// Arguments of the program.
    pub run: String,
    /// Key of the summary, and unit.
    pub key: String,
}

/// A table of numbers.
#[derive(Debug)]
pub struct Table {
    /// Arguments of the program, with `{1}` for the first column.
    pub run: String,
    /// Key and unit of each column; `-` for one that is not checked.
    pub columns: Vec<String>,
    /// Texts of the cells.
    pub rows: Vec<Vec<String>>,
}

/// All pages in the order of the table of contents.
///
/// # Errors
/// Where a page cannot be read.
pub fn pages() -> std::io::Result<Vec<Page>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let contents = std::fs::read_to_string(folder.join("SUMMARY.md"))?;
    let names = contents.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    names
        .map(|name| Ok(Page::new(name.to_owned(), std::fs::read_to_string(folder.join(name))?)))
        .collect()
}

impl Page {
    /// Takes a page apart.
    #[must_use]
    pub fn new(name: String, text: String) -> Self {
        let mut page = Self {
            name,
            fences: Vec::new(),
            words: Vec::new(),
            measured: Vec::new(),
            tables: Vec::new(),
            links: Vec::new(),
            text: String::new(),
        };
        let mut reading = Reading::default();
        for event in Parser::new_ext(&text, Options::ENABLE_TABLES) {
            reading.take(event, &mut page);
        }
        page.text = text;
        page
    }
}

/// What has been met and waits for its end.
#[derive(Default)]
struct Reading {
    fence: Option<Fence>,
    /// Text in front of a comment.
    before: String,
    /// A comment that speaks of the next table.
    table: Option<(String, Vec<String>)>,
    row: Vec<String>,
    cell: Option<String>,
}

impl Reading {
    fn take(&mut self, event: Event<'_>, page: &mut Page) {
        match event {
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(info))) => {
                self.fence = Some(Fence { info: info.to_string(), text: String::new() });
            }
            Event::End(TagEnd::CodeBlock) => page.fences.extend(self.fence.take()),
            Event::Start(Tag::Table(_)) => {
                if let Some((run, columns)) = self.table.take() {
                    page.tables.push(Table { run, columns, rows: Vec::new() });
                }
                self.row.clear();
            }
            Event::Start(Tag::TableCell) => self.cell = Some(String::new()),
            Event::End(TagEnd::TableCell) => self.row.extend(self.cell.take()),
            Event::End(TagEnd::TableHead) => self.row.clear(),
            Event::End(TagEnd::TableRow) => {
                let row = std::mem::take(&mut self.row);
                // Tables without a comment belong to nobody.
                if let Some(t) = page.tables.last_mut().filter(|t| t.columns.len() == row.len()) {
                    t.rows.push(row);
                }
            }
            Event::End(TagEnd::Table) => page.tables.push(Table::none()),
            Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                page.links.push(dest_url.to_string());
            }
            Event::Text(text) => match (&mut self.fence, &mut self.cell) {
                (Some(fence), _) => fence.text.push_str(&text),
                (None, Some(cell)) => cell.push_str(&text),
                (None, None) => self.before.push_str(&text),
            },
            Event::Code(word) => {
                if let Some(cell) = &mut self.cell {
                    cell.push_str(&word);
                }
                self.before.push_str(&word);
                page.words.push(word.to_string());
            }
            Event::SoftBreak | Event::HardBreak => self.before.push(' '),
            Event::Html(html) | Event::InlineHtml(html) => self.comment(&html, page),
            _ => {}
        }
    }

    fn comment(&mut self, html: &str, page: &mut Page) {
        let inner = html.trim().strip_prefix("<!--").and_then(|t| t.strip_suffix("-->"));
        let Some(inner) = inner else { return };
        let inner = inner.split_whitespace().collect::<Vec<_>>().join(" ");
        if let Some(rest) = inner.strip_prefix("table:") {
            let mut parts = rest.split(';').map(|p| p.trim().to_owned());
            let run = parts.next().unwrap_or_default();
            self.table = Some((run, parts.collect()));
        } else if let Some((run, key)) =
            inner.strip_prefix("trilith ").and_then(|t| t.rsplit_once(": "))
        {
            let shown = last_number(&self.before);
            page.measured.push(Measured { shown, run: run.to_owned(), key: key.to_owned() });
        }
    }
}

impl Table {
    fn none() -> Self {
        Self { run: String::new(), columns: Vec::new(), rows: Vec::new() }
    }
}

/// The last number of a text.
fn last_number(text: &str) -> String {
    let part = |c: char| c.is_ascii_digit() || ".eE-−".contains(c);
    let mut words = text.rsplit(|c: char| !part(c));
    words.find(|w| w.contains(|c: char| c.is_ascii_digit())).unwrap_or_default().replace('−', "-")
}
