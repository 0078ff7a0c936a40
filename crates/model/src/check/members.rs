//! Loads along members, forces inside them, envelopes.

use super::{Check, Part};
use crate::{MemberLoad, ModelFault};
use trilith_element::{Range, SpanLoad, norm, sub};

impl Check<'_> {
    /// The length of an element that exists and is a member, m.
    fn member(&mut self, part: &Part, element: usize) -> Option<f64> {
        let m = self.model;
        if !self.index(part, "element", element, m.elements.len()) {
            return None;
        }
        let e = &m.elements[element];
        if m.member(element).is_none() {
            self.unsuitable(part, format!("\"{}\" is no member", e.name));
            return None;
        }
        match e.nodes[..] {
            [i, j] => Some(norm(sub(m.nodes.get(j)?.position, m.nodes.get(i)?.position))),
            _ => None,
        }
    }

    /// A place on a member of that length.
    fn on_member(&mut self, part: &Part, at: f64, length: f64) {
        self.number(part, "at", at, Range::Within(0.0, length * (1.0 + 1e-9)));
    }

    pub(super) fn along(&mut self, part: &Part, loads: &[MemberLoad]) {
        for MemberLoad { element, load } in loads {
            let Some(length) = self.member(part, *element) else { continue };
            let sizes: Vec<f64> = match load {
                SpanLoad::Spread { from, to, start, end } => {
                    self.on_member(part, *from, length);
                    self.on_member(part, *to, length);
                    if from >= to {
                        self.unsuitable(
                            part,
                            "a load along a member begins where it ends, or behind",
                        );
                    }
                    start.iter().chain(end).copied().collect()
                }
                SpanLoad::Point { at, load } => {
                    self.on_member(part, *at, length);
                    load.to_vec()
                }
                SpanLoad::Warmth { rise, gradients: [a, b] } => vec![*rise, *a, *b],
            };
            for x in sizes {
                self.number(part, "load", x, Range::Any);
            }
        }
    }

    pub(super) fn member_force(&mut self, part: &Part, element: usize, at: f64, factor: f64) {
        if let Some(length) = self.member(part, element) {
            self.on_member(part, at, length);
        }
        self.number(part, "factor", factor, Range::Any);
    }

    /// Envelopes name the outputs that follow their stations.
    pub(super) fn envelopes(&mut self) {
        let m = self.model;
        for envelope in &m.envelopes {
            let part = Part::new("envelope", &envelope.name, &(0..0));
            for member in &envelope.members {
                self.index(&part, "element", member.element, m.elements.len());
                let count = member.forces.len() * member.stations.len();
                if count == 0 {
                    let (name, wanted) = ("stations", "at least 1".to_owned());
                    self.report(&part, ModelFault::Count { name, given: 0, wanted });
                    continue;
                }
                let last = member.first.saturating_add(count - 1);
                self.index(&part, "output", last, m.outputs.len());
            }
        }
    }
}
