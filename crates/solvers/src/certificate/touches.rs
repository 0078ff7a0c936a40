//! What outputs jump by where links touch and part, and how sure the moment of that is.
//!
//! A damped stop jumps to c ḋ where it is hit, and the structure is accelerated by that at once. The moment is as sure
//! as the way to the stop:
//!
//! ```text
//! δt = e_d / |ḋ|            e_d: error of the deformation so far
//! ```
//!
//! Within δt an output is off by all of the jump, and no time of comparison need lie there.

use crate::record::Outputs;
use crate::step::State;
use crate::structure::ReducedSystem;
use trilith_model::{Model, Quantity};
use trilith_system::System;

/// Share of the duration by which the moment of a jump may be off without a word.
const MOMENT: f64 = 1e-4;
/// Touches that are kept of a link coordinate: of more, the last ones are no surprise.
const MOST: usize = 10_000;

/// A link coordinate sets in or ends.
struct Touch {
    t: f64,
    /// Length of the step in which it does, s.
    length: f64,
    /// By how much it is deformed in that step, and by how much its force changes.
    way: f64,
    jump: f64,
}

/// What happens at a flat link coordinate.
struct Coordinate {
    flat: usize,
    /// Outputs that jump with its force, and by what share of it.
    shares: Vec<(usize, f64)>,
    /// Force and deformation at the end of the last step.
    last: [f64; 2],
    touches: Vec<Touch>,
    /// Its deformation at the times of comparison from the first one on at which it had been without force.
    way: Vec<(f64, f64)>,
}

/// The touches of a run.
pub(crate) struct Touches {
    coordinates: Vec<Coordinate>,
    t: f64,
}

impl Touches {
    /// None yet, from a state on.
    pub(crate) fn new(
        model: &Model,
        system: &System,
        outputs: &Outputs,
        space: &ReducedSystem,
        (t, state): (f64, &State),
    ) -> Self {
        // Only modes are accelerated as the forces on them say.
        let reduced = space.shape.is_some();
        let modes = if reduced { space.order() - space.readers.columns() } else { 0 };
        let of_modes = outputs.shares(modes);
        let share = |a: usize, flat: usize, output: usize| -> f64 {
            match &model.outputs[output].quantity {
                Quantity::Acceleration { .. } => {
                    let row = space.links.row(a).filter(|(j, _)| *j < modes);
                    row.map(|(j, share)| share * of_modes[output][2][j]).sum()
                }
                _ => {
                    let own = outputs.rows[output].link_forces().iter();
                    own.filter(|(i, _)| *i == flat).map(|(_, factor)| factor).sum()
                }
            }
        };
        let coordinate = |(a, flat): (usize, &usize)| {
            let shares = (0..model.outputs.len()).map(|o| (o, share(a, *flat, o).abs()));
            let shares: Vec<_> = shares.filter(|(_, share)| *share > 0.0).collect();
            let last = [state.f[*flat], state.d[*flat]];
            let of = Coordinate { flat: *flat, shares, last, touches: vec![], way: vec![] };
            (!of.shares.is_empty()).then_some(of)
        };
        let coordinates = system.links.active.iter().enumerate().filter_map(coordinate).collect();
        Self { coordinates, t }
    }

    /// Takes note of the end of a step.
    pub(crate) fn follow(&mut self, t: f64, state: &State) {
        let length = t - std::mem::replace(&mut self.t, t);
        for of in &mut self.coordinates {
            let [f, d] = [state.f[of.flat], state.d[of.flat]];
            let [f0, d0] = std::mem::replace(&mut of.last, [f, d]);
            if (f == 0.0) != (f0 == 0.0) && of.touches.len() < MOST {
                let (way, jump) = ((d - d0).abs(), (f - f0).abs());
                of.touches.push(Touch { t, length, way, jump });
            }
        }
    }

    /// Keeps the deformations at the end of the step that it took note of last.
    pub(crate) fn keep(&mut self) {
        for of in &mut self.coordinates {
            let [f, d] = of.last;
            if f == 0.0 || !of.way.is_empty() {
                of.way.push((self.t, d));
            }
        }
    }

    /// What each of so many outputs jumps by at a moment that is not sure, beside another run of this duration (s);
    /// `safe`: the error over what both are apart.
    pub(crate) fn apart(&self, other: &Self, safe: f64, duration: f64, outputs: usize) -> Vec<f64> {
        let mut most = vec![0.0_f64; outputs];
        for (own, theirs) in self.coordinates.iter().zip(&other.coordinates) {
            let mut common = common(&own.way, &theirs.way).peekable();
            let mut apart = 0.0_f64;
            for touch in &own.touches {
                // Where the other does not touch, only the next time of comparison says so.
                while let Some((t, off)) = common.peek().copied() {
                    apart = apart.max(off);
                    if t >= touch.t {
                        break;
                    }
                    common.next();
                }
                // In lengths of the step, in which a force may also grow without a jump.
                let unsure = safe * apart / touch.way;
                if unsure * touch.length > MOMENT * duration {
                    let jump = touch.jump * unsure.min(1.0);
                    for (output, share) in &own.shares {
                        most[*output] = most[*output].max(share * jump);
                    }
                }
            }
        }
        most
    }
}

/// How far two ways are apart at the times that both know.
fn common<'a>(
    own: &'a [(f64, f64)],
    theirs: &'a [(f64, f64)],
) -> impl Iterator<Item = (f64, f64)> + 'a {
    let mut theirs = theirs.iter().peekable();
    own.iter().filter_map(move |(t, d)| {
        while theirs.next_if(|(other, _)| other < t).is_some() {}
        theirs.next_if(|(other, _)| other == t).map(|(_, other)| (*t, (d - other).abs()))
    })
}
