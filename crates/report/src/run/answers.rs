//! What an engineer asks of a run first, and how far each answer may be off.

use super::data::Answer;
use super::places::{distances, drift, is_margin, isolation, variable};
use trilith_element::Dof;
use trilith_model::{Combine, Model, Output, Quantity};
use trilith_results::{OutputSummary, Recorder, Summary};
use trilith_solvers::BasisReport;

/// A mode with less of the mass than this is not the first of a direction.
const MASS: f64 = 0.1;

/// The answers: of a body that stands free slide, uplift, tilt, margin, closest approach; of a structure period, base
/// shear, travel of bearings, drift, floor acceleration, closest approach of neighbours; of both what struck.
pub(crate) fn answers(seen: &Seen<'_>) -> Vec<Answer> {
    let mut all = Vec::new();
    if seen.summary.contact.is_some() {
        seen.body(&mut all);
    } else {
        let travel = seen.travel();
        seen.periods(&mut all, travel.as_ref());
        seen.structure(&mut all, travel);
    }
    seen.blows(&mut all);
    all
}

/// What is known of a run.
pub(crate) struct Seen<'a> {
    pub model: &'a Model,
    pub summary: &'a Summary,
    pub record: &'a Recorder,
    /// Modes of the structure, where they are known.
    pub modes: Option<&'a BasisReport>,
    /// Weight of the masses, N.
    pub weight: f64,
}

/// How far what carries a structure has moved sideways.
struct Travel {
    largest: f64,
    t: f64,
    last: f64,
    link: String,
}

/// An extreme of an output.
#[derive(Clone, Copy)]
enum Of {
    Size,
    Least,
}

fn answer(words: impl Into<String>, value: f64, unit: &str) -> Answer {
    Answer { words: words.into(), value, unit: unit.into(), ..Answer::default() }
}

impl Seen<'_> {
    /// The answer that an output gives; none where nothing was recorded.
    fn output(&self, words: &str, o: &Output, of: Of) -> Option<Answer> {
        let found = self.summary.outputs.get(&o.name)?;
        let p = found.peak.as_ref()?;
        let (value, t) = match of {
            Of::Least => (p.min, p.t_min),
            Of::Size if p.min.abs() > p.max.abs() => (p.min.abs(), p.t_min),
            Of::Size => (p.max.abs(), p.t_max),
        };
        let error = found.error.map(|e| e.total()).filter(|e| e.is_finite());
        let a =
            Answer { t: Some(t), error, note: o.name.clone(), ..answer(words, value, &found.unit) };
        value.is_finite().then_some(a)
    }

    fn outputs(&self, is: impl Fn(&Quantity) -> bool) -> impl Iterator<Item = &Output> {
        self.model.outputs.iter().filter(move |o| is(&o.quantity))
    }

    /// The largest of the outputs for which this holds, or the least.
    fn extreme(&self, words: &str, of: Of, is: impl Fn(&Output) -> bool) -> Option<Answer> {
        let all = self.model.outputs.iter().filter(|o| is(o));
        let all = all.filter_map(|o| self.output(words, o, of));
        match of {
            Of::Size => all.max_by(|a, b| a.value.total_cmp(&b.value)),
            Of::Least => all.min_by(|a, b| a.value.total_cmp(&b.value)),
        }
    }

    fn history(&self, o: &Output, name: &str) -> bool {
        matches!(o.quantity, Quantity::LinkHistory { element, field } if variable(self.model, element, field) == name)
    }

    fn body(&self, all: &mut Vec<Answer>) {
        let Some(c) = &self.summary.contact else { return };
        let plain =
            |words: &str, text: &str| Answer { text: text.into(), ..answer(words, 0.0, "") };
        all.push(plain("leaves rest by", c.initial_mode));
        all.push(plain("response mode", c.mode));
        all.push(answer("largest slip", c.max_slip, "m"));
        all.push(answer("slip at the end", c.residual_slip, "m"));
        let uplift = self.extreme("largest uplift", Of::Size, |o| self.history(o, "uplift"));
        // The output is certified; a contact elsewhere may have opened farther.
        let whole = uplift.filter(|u| u.value >= 0.999 * c.max_uplift);
        all.push(whole.unwrap_or_else(|| answer("largest uplift", c.max_uplift, "m")));
        all.extend(self.extreme("largest tilt", Of::Size, |o| self.history(o, "tilt")));
        all.extend(self.extreme("margin to overturning", Of::Least, |o| is_margin(self.model, o)));
        let apart = |o: &Output| {
            let least = matches!(o.quantity, Quantity::Combination { how: Combine::Smallest, .. });
            o.unit == "m" && (least || self.history(o, "gap"))
        };
        all.extend(self.extreme("closest approach", Of::Least, apart));
    }

    /// The travel of bearings, or of other links along which a structure moves over the ground.
    fn travel(&self) -> Option<Travel> {
        if let Some(b) = &self.summary.bearings {
            let link = b.farthest.clone().unwrap_or_default();
            return Some(Travel {
                largest: b.max_travel,
                t: b.time,
                last: b.residual_travel,
                link,
            });
        }
        self.summary.base_shear.as_ref()?;
        let all =
            self.record.loops().links().filter_map(|(e, _)| isolation(self.model, self.record, e));
        let most = all.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let (element, largest, t, last) = most;
        let link = self.model.elements[element].name.clone();
        (largest > 0.0).then_some(Travel { largest, t, last, link })
    }

    fn periods(&self, all: &mut Vec<Answer>, travel: Option<&Travel>) {
        // Bearings carry a structure that floats without them: its period is that of the travel it makes.
        if let (Some(travel), Some(v)) = (travel, &self.summary.base_shear) {
            let shear = v.max[0].max(v.max[1]);
            let stiffness = shear / travel.largest;
            if self.weight > 0.0 && stiffness.is_normal() {
                let mass = self.weight / self.model.gravity;
                let period = std::f64::consts::TAU * (mass / stiffness).sqrt();
                let note = "secant: 2π √(mass · travel / base shear)".into();
                all.push(Answer { note, ..answer("period at the largest travel", period, "s") });
            }
            return;
        }
        let Some(modes) = self.modes else { return };
        for (k, axis) in ["X", "Y"].into_iter().enumerate() {
            let carries = |(_, p): &(&f64, &[f64; 3])| p[k] > MASS;
            let first = modes
                .omega
                .iter()
                .zip(&modes.mass_participation)
                .filter(|(w, _)| **w > 0.0)
                .find(carries);
            let Some((omega, share)) = first else { continue };
            let note = format!("{:.0} % of the mass; without links", 100.0 * share[k]);
            let period = std::f64::consts::TAU / omega;
            all.push(Answer { note, ..answer(format!("first period {axis}"), period, "s") });
        }
    }

    fn structure(&self, all: &mut Vec<Answer>, travel: Option<Travel>) {
        let s = self.summary;
        if let Some(shear) = &s.base_shear {
            for (k, dof) in [Dof::Ux, Dof::Uy].into_iter().enumerate() {
                let (value, axis) = (shear.max[k], ["X", "Y"][k]);
                if value <= 1e-9 * shear.max[0].max(shear.max[1]) {
                    continue;
                }
                let same = self.outputs(|q| *q == Quantity::BaseShear { direction: dof });
                let error = same
                    .filter_map(|o| s.outputs.get(&o.name)?.error)
                    .map(|e| e.total())
                    .find(|e| e.is_finite())
                    .or_else(|| self.twin(value, shear.time[k], "N"));
                let share = value / self.weight;
                let note = match share.is_finite() {
                    true => format!("{:.1} % of the weight", 100.0 * share),
                    false => String::new(),
                };
                let t = Some(shear.time[k]);
                all.push(Answer {
                    t,
                    error,
                    note,
                    ..answer(format!("base shear {axis}"), value, "N")
                });
            }
        }
        if let Some(Travel { largest, t, last, link }) = travel {
            let error = self.twin(largest, t, "m").or_else(|| self.travel_error(&link));
            let found = answer("largest travel of bearings", largest, "m");
            all.push(Answer { t: Some(t), note: link, error, ..found });
            all.push(answer("travel at the end", last, "m"));
        }
        if let Some(b) = s.bearings.as_ref().filter(|b| b.max_uplift > 0.0) {
            all.push(answer("uplift of bearings", b.max_uplift, "m"));
        }
        if let Some(d) = &s.drift {
            let of = self.model.outputs.iter().find(|o| o.name == d.output);
            let share = of.and_then(|o| match &o.quantity {
                Quantity::Displacement(t) => drift(self.model, t).map(|_| t[0].factor.abs()),
                _ => None,
            });
            let found = s.outputs.get(&d.output);
            let error =
                found.and_then(|o| Some(o.error?.total() / share?)).filter(|e| e.is_finite());
            let note = format!("{:.2} % of the height, {}", 100.0 * d.ratio, d.output);
            all.push(Answer { error, note, ..answer("largest drift", d.max, "m") });
        }
        let shaken =
            |o: &Output| matches!(&o.quantity, Quantity::Acceleration { absolute: true, .. });
        all.extend(self.extreme("largest floor acceleration", Of::Size, shaken));
        let apart = distances(&self.model.outputs);
        let of = self.model.outputs.iter().zip(apart).filter(|(_, apart)| *apart);
        let closest = of.filter_map(|(o, _)| self.output("closest approach", o, Of::Least));
        all.extend(closest.min_by(|a, b| a.value.total_cmp(&b.value)));
    }

    /// How far an output may be off that has the same extreme at the same time: it is the same thing.
    fn twin(&self, value: f64, t: f64, unit: &str) -> Option<f64> {
        let near =
            |x: f64, at: f64| (x.abs() - value).abs() <= 1e-4 * value && (at - t).abs() <= 1e-6;
        let all = self.summary.outputs.0.iter().map(|(_, o)| o).filter(|o| o.unit == unit);
        let same = |o: &&OutputSummary| {
            o.peak.as_ref().is_some_and(|p| near(p.max, p.t_max) || near(p.min, p.t_min))
        };
        all.filter(same).filter_map(|o| o.error).map(|e| e.total()).find(|e| e.is_finite())
    }

    /// How far the travel of a bearing may be off: that of its deformations among the outputs.
    fn travel_error(&self, link: &str) -> Option<f64> {
        let element = self.model.elements.iter().position(|e| e.name == link)?;
        let of = |q: &Quantity| matches!(q, Quantity::LinkDeformation { element: e, .. } if *e == element);
        let errors: Vec<f64> = self
            .outputs(of)
            .filter_map(|o| Some(self.summary.outputs.get(&o.name)?.error?.total()))
            .collect();
        let sum = errors.iter().map(|e| e * e).sum::<f64>().sqrt();
        // Both shear directions, or it is not known.
        (errors.len() > 1 && sum.is_finite()).then_some(sum)
    }

    fn blows(&self, all: &mut Vec<Answer>) {
        let Some(stops) = &self.summary.stops else { return };
        all.push(Answer { text: stops.hits.to_string(), ..answer("hits of stops", 0.0, "") });
        if stops.largest_force > 0.0 {
            let note = stops.hardest.clone().unwrap_or_default();
            let t = Some(stops.time);
            let error = self.twin(stops.largest_force, stops.time, "N");
            let found = answer("largest force of a stop", stops.largest_force, "N");
            all.push(Answer { t, note, error, ..found });
        }
    }
}
