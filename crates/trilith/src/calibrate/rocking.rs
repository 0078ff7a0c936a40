//! Rocking from corner to corner.

use super::body::{Body, Pose};
use super::root::falling_root;
use super::{CalibrationError, Calibrator};
use crate::{Error, Model};
use std::sync::Arc;
use trilith_element::{Frame, Values};
use trilith_elements::Spring;
use trilith_model as model;

/// Rigid theory of small rocking between the outer feet, plastic contacts: Housner 1963.
///
/// ```text
///   angular momentum about the struck corner R:  e_H = (I_c + m r_L·r_R) / (I_c + m |r_R|²)
///   energy:  θ₁/θ₀ = e_H² (I_R b_L) / (I_L b_R),   t₀ = √(2 θ₀ I_L / (m g b_L))
/// ```
///
/// L is the corner that the body stands on first, b the horizontal distance from a corner to the centre
/// of gravity. For a rectangular block e_H = 1 − 3/2 sin²α.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rocking {
    /// Angular speed after over angular speed before an impact.
    pub speed: f64,
    /// Uplift of the next swing over that of the swing before.
    pub uplift: f64,
    /// Tilt at which the body stands on its corner in balance, rad.
    pub balance: f64,
    /// Distance of the outer feet, m.
    pub width: f64,
    inertia: f64,
    arm: f64,
    weight: f64,
}

impl Rocking {
    fn new(body: &Body) -> Result<Self, CalibrationError> {
        let [left, right] = body.ends()?;
        let (l, r) = (&body.feet[left[0]], &body.feet[right[0]]);
        let arms = [[body.x - l.x, body.z - l.z], [body.x - r.x, body.z - r.z]];
        let dot = |a: [f64; 2], b: [f64; 2]| body.inertia + body.mass * (a[0] * b[0] + a[1] * b[1]);
        let (of_l, of_r) = (dot(arms[0], arms[0]), dot(arms[1], arms[1]));
        let speed = dot(arms[0], arms[1]) / of_r;
        Ok(Self {
            speed,
            uplift: speed * speed * of_r * arms[0][0] / (of_l * -arms[1][0]),
            balance: (arms[0][0] / arms[0][1]).atan(),
            width: r.x - l.x,
            inertia: of_l,
            arm: arms[0][0],
            weight: body.mass * body.gravity,
        })
    }

    /// Time from rest at an uplift (m) of the far corner to the impact, s.
    #[must_use]
    pub fn quarter(&self, uplift: f64) -> f64 {
        (2.0 * uplift / self.width * self.inertia / (self.weight * self.arm)).sqrt()
    }
}

/// One swing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// Uplift of one outer foot at the start, m.
    pub before: f64,
    /// Largest uplift of the other one afterwards, m.
    pub after: f64,
}

impl Swing {
    /// Uplift after over uplift before.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.after / self.before
    }
}

impl Calibrator {
    /// Rigid theory for this body.
    ///
    /// # Errors
    /// [`CalibrationError`] for a body that cannot rock.
    pub fn theory(&self) -> Result<Rocking, Error> {
        Ok(Rocking::new(&self.body)?)
    }

    /// Lets the body go with the foot at the larger end lifted by `uplift` (m), held by a force there
    /// until then, and measures how far the other end rises after the impact. `dashpot` (N·m·s/rad)
    /// resists its rotation.
    ///
    /// # Errors
    /// [`CalibrationError`] for a body that cannot rock or an uplift that is not positive, and where
    /// the run fails.
    pub fn rocking(&mut self, uplift: f64, dashpot: f64) -> Result<Swing, Error> {
        if !(uplift > 0.0 && uplift.is_finite()) {
            return Err(CalibrationError::Range { what: "uplift", value: uplift }.into());
        }
        if !(dashpot >= 0.0 && dashpot.is_finite()) {
            return Err(
                CalibrationError::Range { what: "rotational dashpot", value: dashpot }.into()
            );
        }
        let theory = Rocking::new(&self.body)?;
        let [left, right] = self.body.ends()?;
        let feet = &self.body.feet;
        let (l, r) = (&feet[left[0]], &feet[right[0]]);
        // The force at the lifted end holds its share of the weight, the other foot the rest.
        let share = (r.x - self.body.x) / theory.width;
        let stiffness: f64 = left.iter().map(|i| feet[*i].stiffness).sum();
        let compression = share * self.body.mass * self.body.gravity / stiffness;
        let lift = -compression - l.opening;
        let rotation = (uplift - r.opening - lift) / theory.width;
        let pose = Pose { lift, rotation, about: [l.x, l.z] };
        // The far end tops after at most two quarters and lands after three.
        let duration = 3.0 * theory.quarter(uplift);
        let added = self.add_dashpot(dashpot);
        let gaps = self.release(pose, duration);
        if added {
            self.model.elements.pop();
        }
        let far = |g: &Vec<f64>| left.iter().map(|i| g[*i]).fold(f64::NEG_INFINITY, f64::max);
        let after = gaps?.seen.iter().map(|(_, g)| far(g)).fold(0.0, f64::max);
        Ok(Swing { before: uplift, after })
    }

    /// Finds the rotational dashpot (N·m·s/rad) with which a swing from an uplift (m) keeps `ratio` of it.
    ///
    /// # Errors
    /// As [`rocking`](Self::rocking), and [`CalibrationError::Unreachable`] where the contacts alone
    /// take more than that.
    pub fn tune_rocking(&mut self, ratio: f64, uplift: f64) -> Result<(f64, Swing), Error> {
        if !(ratio > 0.0 && ratio < 1.0) {
            let what = "uplift kept by a swing";
            return Err(CalibrationError::Range { what, value: ratio }.into());
        }
        let theory = Rocking::new(&self.body)?;
        let without = self.rocking(uplift, 0.0)?.ratio();
        if without < ratio {
            let what = "an uplift ratio of";
            return Err(CalibrationError::Unreachable { what, wanted: ratio, without }.into());
        }
        // First order in the dashpot: ratio ≈ without · (1 − 2/3 k t₀ (1 + e_H)), k = c/I.
        let slope = 2.0 / 3.0 * theory.quarter(uplift) * (1.0 + theory.speed) / theory.inertia;
        let guess = 1.5 * (1.0 - ratio / without).max(1e-3) / slope;
        let dashpot =
            falling_root(0.0, guess, |c| Ok::<_, Error>(self.rocking(uplift, c)?.ratio() - ratio))?;
        Ok((dashpot, self.rocking(uplift, dashpot)?))
    }

    /// Name of a node that turns with the body, where a rotational dashpot can be put.
    #[must_use]
    pub fn dashpot_node(&self) -> Option<&str> {
        turning_node(&self.model, &self.body).map(|n| self.model.nodes[n].name.as_str())
    }

    fn add_dashpot(&mut self, dashpot: f64) -> bool {
        let Some(node) = turning_node(&self.model, &self.body).filter(|_| dashpot > 0.0) else {
            return false;
        };
        let Ok(frame) = Frame::of_nodes(&[self.model.nodes[node].position], None, None) else {
            return false;
        };
        // On the ground local 1 is +Z, local 2 is +X and local 3 is +Y.
        let spring = match self.body.horizontal {
            super::Horizontal::X => Spring { cr3: dashpot, ..Spring::default() },
            super::Horizontal::Y => Spring { cr2: dashpot, ..Spring::default() },
        };
        self.model.elements.push(model::Element {
            name: "rocking dashpot".into(),
            kind: "Spring",
            nodes: vec![node],
            frame,
            body: model::Body::Linear(Arc::new(spring)),
            span: 0..0,
            values: Values::default().into(),
            axes: [None, None],
            section: None,
        });
        true
    }
}

/// The node closest to the centre of gravity; every node of the body turns as it does.
fn turning_node(model: &Model, body: &Body) -> Option<usize> {
    let along = body.horizontal.directions().0;
    let distance = |n: &usize| {
        let p = model.nodes[*n].position;
        (p[along] - body.x).hypot(p[2] - body.z)
    };
    (0..model.nodes.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
}
