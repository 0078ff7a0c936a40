//! Tokens as blocks within blocks.

use super::tokens::{Span, Token, Tokens};

/// The block around all others, which has no brackets.
pub(crate) const ROOT: usize = 0;

/// A kind of bracket.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bracket {
    /// The whole text.
    None,
    /// `(…)`.
    Round,
    /// `[…]`.
    Square,
    /// `{…}`.
    Curly,
}

/// What stands between brackets.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    pub bracket: Bracket,
    /// The block and the entry that it is the value of; the root is its own.
    pub parent: (usize, usize),
    /// The name before the bracket.
    pub name: Option<Span>,
    /// Place of the opening bracket, and behind the closing one or where it would be.
    pub span: Span,
    pub closed: bool,
    pub entries: Vec<Entry>,
}

/// A key with its value, or a value alone.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    /// From its first token to its last.
    pub span: Span,
    pub key: Option<Key>,
    pub value: Option<Value>,
}

/// What stands before a colon.
#[derive(Clone, Debug)]
pub(crate) struct Key {
    /// Without quotes.
    pub span: Span,
    pub quoted: bool,
    /// Where the colon is.
    pub colon: usize,
}

/// A value of an entry.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Word(Span),
    /// A text: its content, and whether its quotes end.
    Text(Span, bool),
    Block(usize),
}

/// A text as blocks.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// The root first; a block stands behind the one that it is in.
    pub blocks: Vec<Block>,
    /// Comments, in order, and whether each goes to the end of its line.
    pub comments: Vec<(Span, bool)>,
}

impl Tree {
    /// Takes a text apart.
    pub fn new(text: &str) -> Self {
        let root = Block {
            bracket: Bracket::None,
            parent: (ROOT, 0),
            name: None,
            span: 0..text.len(),
            closed: true,
            entries: Vec::new(),
        };
        let tree = Self { blocks: vec![root], comments: Vec::new() };
        let mut building =
            Building { tree, stack: vec![ROOT], open: [0; 4], fresh: true, last: None };
        for (token, span) in Tokens::new(text) {
            building.take(token, span);
        }
        let Building { mut tree, stack, .. } = building;
        for open in stack.into_iter().skip(1) {
            tree.blocks[open].span.end = text.len();
        }
        tree
    }

    /// The innermost block around a place between two bytes.
    pub fn around(&self, at: usize) -> usize {
        let mut found = ROOT;
        loop {
            let inside = |b: &usize| {
                let Block { span, closed, .. } = &self.blocks[*b];
                span.start < at && (at < span.end || !closed && at <= span.end)
            };
            // Entries stand in order: the last one that begins before the place is the only one that can hold it.
            let entries = &self.blocks[found].entries;
            let i = entries.partition_point(|e| e.span.start < at);
            let child = entries[..i].last().and_then(|e| match e.value {
                Some(Value::Block(b)) => Some(b),
                _ => None,
            });
            match child.filter(inside) {
                Some(child) => found = child,
                None => return found,
            }
        }
    }

    /// True inside of a comment, or at the end of one that goes on there.
    pub fn in_comment(&self, at: usize) -> bool {
        let i = self.comments.partition_point(|(span, _)| span.start < at);
        self.comments[..i]
            .last()
            .is_some_and(|(span, line)| at < span.end || *line && at == span.end)
    }

    /// The blocks from the root to this one.
    pub fn path(&self, mut block: usize) -> Vec<usize> {
        let mut path = vec![block];
        while block != ROOT {
            block = self.blocks[block].parent.0;
            path.push(block);
        }
        path.reverse();
        path
    }

    /// The block of the model, `(…)`.
    pub fn model(&self) -> Option<&Block> {
        self.blocks[ROOT].entries.iter().find_map(|e| match e.value {
            Some(Value::Block(b)) => Some(&self.blocks[b]),
            _ => None,
        })
    }

    /// The block that is the value of a field.
    pub fn field<'s>(&'s self, of: &Block, text: &str, name: &str) -> Option<&'s Block> {
        let found = of.entries.iter().find(|e| e.key_text(text) == Some(name))?;
        match found.value {
            Some(Value::Block(b)) => Some(&self.blocks[b]),
            _ => None,
        }
    }
}

impl Entry {
    /// Its key.
    pub fn key_text<'t>(&self, text: &'t str) -> Option<&'t str> {
        text.get(self.key.as_ref()?.span.clone())
    }
}

struct Building {
    tree: Tree,
    /// The blocks that are open.
    stack: Vec<usize>,
    /// How many of them there are of each bracket: what is not there is not looked for.
    open: [usize; 4],
    /// The next token begins an entry.
    fresh: bool,
    /// The token before, where it may be a key or a name.
    last: Option<(Token, Span)>,
}

impl Building {
    fn top(&mut self) -> &mut Block {
        let top = self.stack.last().copied().unwrap_or(ROOT);
        &mut self.tree.blocks[top]
    }

    /// The entry that a token at this place belongs to.
    fn entry(&mut self, span: &Span) -> &mut Entry {
        let fresh = std::mem::replace(&mut self.fresh, false);
        let entries = &mut self.top().entries;
        if fresh || entries.is_empty() {
            entries.push(Entry { span: span.clone(), key: None, value: None });
        }
        let last = entries.len() - 1;
        entries[last].span.end = span.end;
        &mut entries[last]
    }

    /// Where the innermost open block of a bracket is.
    fn innermost(&self, bracket: Bracket) -> Option<usize> {
        if self.open[bracket as usize] == 0 {
            return None;
        }
        self.stack.iter().rposition(|b| self.tree.blocks[*b].bracket == bracket)
    }

    /// Ends the innermost block.
    fn pop(&mut self, end: usize, closed: bool) {
        if self.stack.len() > 1 {
            let top = self.top();
            (top.span.end, top.closed) = (end, closed);
            let bracket = top.bracket;
            self.open[bracket as usize] -= 1;
            self.stack.pop();
            let top = self.top();
            if let Some(e) = top.entries.last_mut() {
                e.span.end = end;
            }
        }
        self.fresh = false;
    }

    fn take(&mut self, token: Token, span: Span) {
        let last = self.last.take();
        match token {
            Token::Comment { line } => {
                self.tree.comments.push((span, line));
                self.last = last;
            }
            Token::Comma => self.fresh = true,
            Token::Colon => self.key(last, &span),
            Token::Word | Token::Text { .. } => {
                self.part(last.as_ref());
                let value = match token {
                    Token::Text { inner, closed } => Value::Text(inner.0..inner.1, closed),
                    _ => Value::Word(span.clone()),
                };
                self.entry(&span).value = Some(value);
                self.last = Some((token, span));
            }
            Token::Open(bracket) => {
                let name = last.filter(|(t, _)| *t == Token::Word && bracket == b'(');
                if name.is_none() && self.has_block() {
                    self.fresh = true;
                }
                let block = self.tree.blocks.len();
                self.entry(&span).value = Some(Value::Block(block));
                let at = self.stack.last().copied().unwrap_or(ROOT);
                let parent = (at, self.top().entries.len() - 1);
                let bracket = match bracket {
                    b'(' => Bracket::Round,
                    b'[' => Bracket::Square,
                    _ => Bracket::Curly,
                };
                self.tree.blocks.push(Block {
                    bracket,
                    parent,
                    name: name.map(|(_, span)| span),
                    span: span.start..span.end,
                    closed: false,
                    entries: Vec::new(),
                });
                self.stack.push(block);
                self.open[bracket as usize] += 1;
                self.fresh = true;
            }
            Token::Close(bracket) => self.close(bracket, &span),
        }
    }

    /// True where the entry has a block for its value already: what follows is another one, after a comma that is missing.
    fn has_block(&mut self) -> bool {
        !self.fresh
            && matches!(self.top().entries.last(), Some(Entry { value: Some(Value::Block(_)), .. }))
    }

    /// A word or a text behind another one, or behind a block, is an entry of its own: the comma is missing.
    fn part(&mut self, last: Option<&(Token, Span)>) {
        if last.is_some() || self.has_block() {
            self.fresh = true;
        }
    }

    /// What stood before a colon is a key.
    fn key(&mut self, last: Option<(Token, Span)>, colon: &Span) {
        let Some((token, span)) = last else { return };
        let quoted = matches!(token, Token::Text { .. });
        let home = if quoted { Bracket::Curly } else { Bracket::Round };
        let depth = self.innermost(home);
        if let Some(depth) = depth.filter(|d| d + 1 < self.stack.len()) {
            // It was taken for an entry of a bracket that is not closed.
            self.top().entries.pop();
            while self.stack.len() > depth + 1 {
                self.pop(span.start, false);
            }
            self.fresh = true;
        }
        let inner = match token {
            Token::Text { inner, .. } => inner.0..inner.1,
            _ => span.clone(),
        };
        let entry = self.entry(&span);
        entry.span.end = colon.end;
        entry.value = None;
        entry.key = Some(Key { span: inner, quoted, colon: colon.start });
        self.fresh = false;
    }

    /// Closes the innermost block of this bracket, and those in it; a bracket that closes nothing is passed over.
    fn close(&mut self, bracket: u8, span: &Span) {
        let home = match bracket {
            b')' => Bracket::Round,
            b']' => Bracket::Square,
            _ => Bracket::Curly,
        };
        let Some(depth) = self.innermost(home) else { return };
        while self.stack.len() > depth + 1 {
            self.pop(span.start, false);
        }
        self.pop(span.end, true);
    }
}
