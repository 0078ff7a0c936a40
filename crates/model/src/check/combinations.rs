//! Combinations of cases.

use super::{Check, Part};
use crate::CombinationTerm;
use trilith_element::Range;

impl Check<'_> {
    pub(super) fn combinations(&mut self) {
        let m = self.model;
        for (own, combination) in m.combinations.iter().enumerate() {
            let part = Part::new("combination", &combination.name, &(0..0));
            if combination.terms.is_empty() {
                self.unsuitable(&part, "it combines nothing");
            }
            if let Some(case) = m.case(&combination.name) {
                self.unsuitable(&part, format!("case {case} has the same name"));
            }
            for (term, factor) in &combination.terms {
                self.number(&part, "factor", *factor, Range::Any);
                match *term {
                    CombinationTerm::Case(case) => {
                        self.index(&part, "case", case, m.cases.len());
                    }
                    CombinationTerm::Combination(other) => {
                        if self.index(&part, "combination", other, m.combinations.len())
                            && other >= own
                        {
                            let name = &m.combinations[other].name;
                            self.unsuitable(&part, format!("\"{name}\" does not stand before it"));
                        }
                    }
                }
            }
        }
    }
}
