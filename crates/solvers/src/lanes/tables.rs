//! Amplitudes of loads at the steps of a case: made once for all analyses whose loads differ by a factor.

use super::grid::{Grid, Piece};
use super::way::FULL;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError, Weak};
use trilith_model::{Custom, Harmonic, Side, TimeFunction};
use trilith_system::Track;

/// Parts of a step, a power of two, at whose ends amplitudes are known where steps are adaptive.
const PARTS: u32 = 8;
/// Steps of which they are known at most.
const MOST: usize = 1 << 16;

/// Amplitude of a load at the steps of a grid.
#[derive(Debug)]
pub(super) struct Table {
    /// At the start and at the end of every step.
    pub ends: Vec<[f64; 2]>,
    /// The same with those between its [`PARTS`] parts, where steps are adaptive: all that a step asks for lies together.
    parts: Vec<[f64; PARTS as usize + 1]>,
}

impl Table {
    /// At a tick of a step, [`FULL`] of which make it up; none where it is not known.
    #[inline]
    pub fn at(&self, step: usize, tick: u32) -> Option<f64> {
        const PART: u32 = FULL / PARTS;
        match self.parts.get(step) {
            Some(parts) if tick.is_multiple_of(PART) => parts.get((tick / PART) as usize).copied(),
            Some(_) => None,
            None => match (self.ends.get(step)?, tick) {
                ([start, _], 0) => Some(*start),
                ([_, end], FULL) => Some(*end),
                _ => None,
            },
        }
    }
}

#[derive(Debug)]
struct Entry {
    grid: Grid,
    inside: bool,
    track: Track,
    table: Weak<Table>,
}

/// Tables that are kept though nobody uses them at the moment.
const KEPT: usize = 8;

/// The tables in use, and the last ones made.
#[derive(Debug, Default)]
pub struct Tables(Mutex<Store>);

#[derive(Debug, Default)]
struct Store {
    entries: Vec<Entry>,
    kept: VecDeque<Arc<Table>>,
}

/// A time function of unit amplitude, and the amplitude.
fn unit(function: &TimeFunction) -> (TimeFunction, f64) {
    use TimeFunction as F;
    let one = |h: &Harmonic| Harmonic { amplitude: 1.0, ..*h };
    match function {
        F::Constant(x) => (F::Constant(1.0), *x),
        F::Step { amplitude, start, end } => {
            (F::Step { amplitude: 1.0, start: *start, end: *end }, *amplitude)
        }
        F::Ramp { amplitude, start, rise } => {
            (F::Ramp { amplitude: 1.0, start: *start, rise: *rise }, *amplitude)
        }
        F::Sine(h) => (F::Sine(one(h)), h.amplitude),
        F::Cosine(h) => (F::Cosine(one(h)), h.amplitude),
        F::HalfSine { amplitude, duration, start } => {
            (F::HalfSine { amplitude: 1.0, duration: *duration, start: *start }, *amplitude)
        }
        F::Ricker { amplitude, frequency, center } => {
            (F::Ricker { amplitude: 1.0, frequency: *frequency, center: *center }, *amplitude)
        }
        F::Custom(c) => (F::Custom(Custom { amplitude: 1.0, ..c.clone() }), c.amplitude),
        F::Table(_) => (function.clone(), 1.0),
    }
}

/// A track of unit factor and amplitude, and their product.
pub(super) fn split(track: &Track) -> (Track, f64) {
    let part = |function: &TimeFunction, factor: f64| {
        let (function, amplitude) = unit(function);
        (function, amplitude * factor)
    };
    match track {
        Track::Constant => (Track::Constant, 1.0),
        Track::Value { function, factor } => {
            let (function, size) = part(function, *factor);
            (Track::Value { function, factor: 1.0 }, size)
        }
        Track::Rate { function, factor } => {
            let (function, size) = part(function, *factor);
            (Track::Rate { function, factor: 1.0 }, size)
        }
        Track::Curvature { function, factor } => {
            let (function, size) = part(function, *factor);
            (Track::Curvature { function, factor: 1.0 }, size)
        }
    }
}

fn same(a: &Track, b: &Track) -> bool {
    match (a, b) {
        (Track::Constant, Track::Constant) => true,
        (Track::Value { function: f, .. }, Track::Value { function: g, .. })
        | (Track::Rate { function: f, .. }, Track::Rate { function: g, .. })
        | (Track::Curvature { function: f, .. }, Track::Curvature { function: g, .. }) => f == g,
        _ => false,
    }
}

fn fill(track: &Track, grid: Grid, inside: bool) -> Table {
    let (mut ends, mut parts) = (Vec::with_capacity(grid.steps * grid.substeps), Vec::new());
    for step in 0..grid.steps {
        for i in 0..grid.substeps {
            let Piece { start, end, length, .. } = grid.usual(step, i);
            let [first, last] = [track.at(start, Side::After), track.at(end, Side::Before)];
            ends.push([first, last]);
            let at = |part: usize| start + length * (part as f64 / f64::from(PARTS));
            if inside {
                parts.push(std::array::from_fn(|part| match part as u32 {
                    0 => first,
                    PARTS => last,
                    _ => track.at(at(part), Side::Before),
                }));
            }
        }
    }
    Table { ends, parts }
}

impl Tables {
    /// None yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The table of a track of unit amplitude, and its amplitude. `inside`: where steps are adaptive.
    pub(super) fn of(&self, track: &Track, grid: Grid, inside: bool) -> (Arc<Table>, f64) {
        let (track, size) = split(track);
        let inside = inside && grid.steps * grid.substeps <= MOST;
        let mut store = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        store.entries.retain(|e| e.table.strong_count() > 0);
        let fits = |e: &&Entry| (e.grid, e.inside) == (grid, inside) && same(&e.track, &track);
        let found = store.entries.iter().filter(fits);
        if let Some(table) = { found }.find_map(|e| e.table.upgrade()) {
            return (table, size);
        }
        drop(store);
        let table = Arc::new(fill(&track, grid, inside));
        let mut store = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        store.entries.push(Entry { grid, inside, track, table: Arc::downgrade(&table) });
        store.kept.push_back(Arc::clone(&table));
        if store.kept.len() > KEPT {
            store.kept.pop_front();
        }
        (table, size)
    }
}
