//! Damping of the model, and the geometric stiffness that stands for transformations.

use super::args::{Args, Told};
use super::recorder::Recorder;
use super::tcl::Value;
use crate::ron::{Ron, number};

impl Recorder<'_> {
    pub(super) fn rayleigh(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "rayleigh alphaM betaK betaKinit betaKcomm");
        let new = a.numbers::<4>("alphaM, betaK, betaKinit, betaKcomm")?;
        if new.iter().any(|x| *x < 0.0) {
            self.lose("a factor below zero is not written");
        }
        self.changed();
        if self.analysis.rayleigh.is_some_and(|old| old != new && old != [0.0; 4]) {
            self.lose("a damping that changes: the model has the last one");
        }
        if new[1] != 0.0 || new[3] != 0.0 {
            self.otherwise(
                "the stiffness that damps is that of the elastic structure, without links",
            );
        }
        self.analysis.rayleigh = Some(new);
        Ok(())
    }

    pub(super) fn modal_damping(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "modalDamping ratio …");
        let mut ratios = vec![a.number("a ratio")?];
        ratios.extend(a.all());
        self.changed();
        self.analysis.modal = Some(ratios);
        Ok(())
    }

    /// Damping of the model, and geometric stiffness.
    pub(super) fn write_damping(&mut self) {
        self.command = "geomTransf".into();
        if let Some((kind, line)) = self.analysis.geometric.clone() {
            self.line = line;
            match (kind.as_str(), self.analysis.last_static.clone()) {
                ("PDelta", Some(case)) => {
                    let what = format!("PDelta: axial forces of {case} stiffen all beams and trusses, and stay (`p_delta`)");
                    self.otherwise(&what);
                    self.draft.p_delta = self.analysis.last_static.clone();
                }
                ("PDelta", None) => self.lose("PDelta without a static analysis: nothing has an axial force, it is written as Linear"),
                _ => self.lose("Corotational: displacements are small here, it is written as Linear"),
            }
        }
        let rayleigh = self.analysis.rayleigh.filter(|r| *r != [0.0; 4]);
        self.command = "modalDamping".into();
        self.line = String::new();
        if let Some([m, k, initial, committed]) = rayleigh {
            if self.analysis.modal.is_some() {
                self.lose("modal damping beside that of Rayleigh is not written");
            }
            let k = k + initial + committed;
            if k != 0.0 {
                for u in std::mem::take(&mut self.undamped) {
                    if let Some(found) = self.draft.elements.iter_mut().find(|(n, _)| *n == u.name)
                    {
                        found.1 = u.instead;
                    }
                    for (node, mass) in u.masses {
                        self.nodes[node].brought += mass;
                    }
                }
            }
            self.draft.damping =
                Some(Ron::block("Rayleigh").with("mass", m.max(0.0)).with("stiffness", k.max(0.0)));
        } else if let Some(ratios) = self.analysis.modal.clone() {
            let same = ratios.windows(2).all(|w| w[0] == w[1]);
            if same {
                self.draft.damping = Some(Ron::block("Modal").with("ratio", ratios[0]));
                self.otherwise("all modes are damped, not only those of the last `eigen`");
            } else if ratios.len() <= self.analysis.eigen.len() {
                let points = self.analysis.eigen.iter().zip(&ratios).map(|(w, z)| {
                    let f = format!("{} Hz", number(w.max(0.0).sqrt() / std::f64::consts::TAU));
                    Ron::Tuple(vec![Ron::Text(f), Ron::Number(*z)])
                });
                self.draft.damping =
                    Some(Ron::block("ModalTable").with("points", Ron::List(points.collect())));
                self.otherwise(
                    "ratios lie at the frequencies of `eigen`, and on straight lines between them",
                );
            } else {
                self.lose("ratios of modes that no `eigen` has found are not written");
            }
        }
    }
}
