//! Loads along a [`Beam`].
//!
//! ```text
//!   forces that hold the ends = −∫ Nᵀ q dx       N: displacements by unit motions of the ends, with shear  [Betti]
//!   warmth: N₀ = E A α ΔT,  κ₀ = −α g₂ about local 3,  α g₃ about local 2
//! ```
//!
//! Released ends follow as the stiffness does; what acts on a rigid length acts on its node.
//!
//! Reference: \[Przemieniecki 1968, §5.6, §8.3\].

use super::matrices::{IN_12, IN_13};
use super::{Beam, Section, Stiffened, span_along_axis_1};
use trilith_element::{Geometry, Member, ParameterError, SpanLoad};

/// A bending plane: whether it has a stiffness, its Φ, the flexible length.
struct Bending {
    stiff: bool,
    phi: f64,
    length: f64,
}

impl Bending {
    /// Deflections at a share of the length by unit deflections and slopes of both ends, and rotations of the section.
    fn shapes(&self, x: f64) -> [[f64; 4]; 2] {
        let Self { stiff, phi, length: l } = self;
        if !stiff {
            return [[1.0 - x, 0.0, x, 0.0], [-1.0 / l, 0.0, 1.0 / l, 0.0]];
        }
        let (f, half) = (1.0 / (1.0 + phi), 0.5 * phi * x * (1.0 - x));
        let cubic = x * x * (3.0 - 2.0 * x);
        let deflection = [
            f * (1.0 - cubic + phi * (1.0 - x)),
            f * l * (x * (1.0 - x).powi(2) + half),
            f * (cubic + phi * x),
            f * l * (-x * x * (1.0 - x) - half),
        ];
        let bump = f * 6.0 * x * (1.0 - x) / l;
        let rotation = [
            -bump,
            f * (1.0 - 4.0 * x + 3.0 * x * x + phi * (1.0 - x)),
            bump,
            f * (3.0 * x * x - 2.0 * x + phi * x),
        ];
        [deflection, rotation]
    }
}

impl Member for Beam {
    fn end_loads(&self, at: &Geometry<'_>, load: &SpanLoad) -> Result<[f64; 12], ParameterError> {
        let whole = span_along_axis_1(at, "beam")?;
        let flexible = self.flexible(whole)?;
        let section = self.section();
        let mut k = self.stiffness(&section, whole, flexible, at.tension);
        let mut inner = match load {
            SpanLoad::Warmth { rise, gradients } => self.warmth(&section, *rise, *gradients)?,
            load => self.carried(&section, whole, flexible, load),
        };
        let mut none = nalgebra::DMatrix::zeros(12, 12);
        self.release(&mut k, &mut none, &mut inner)?;
        let mut ends = [0.0; 12];
        let arms = self.arms();
        for (i, sum) in ends.iter_mut().enumerate() {
            *sum = (0..12).map(|j| arms[(j, i)] * inner[j]).sum();
        }
        self.on_rigid(whole, load, &mut ends);
        Ok(ends)
    }
}

impl Beam {
    /// What holds the flexible ends, reversed, of what acts between them.
    fn carried(&self, s: &Section, whole: f64, flexible: f64, load: &SpanLoad) -> [f64; 12] {
        let [phi12, phi13] = self.shear_ratios(s, flexible);
        let plane = |i: f64, phi| Bending { stiff: i > 0.0, phi, length: flexible };
        let planes = [(IN_12, plane(s.i3, phi12), 1, 5), (IN_13, plane(s.i2, phi13), 2, 4)];
        let mut ends = [0.0; 12];
        let (from, to) = (self.offset_i, self.offset_i + flexible);
        load.over([from, to], |x, q| {
            let share = (x - from) / flexible;
            let along = match self.offsets_stiffen {
                Stiffened::All => share,
                Stiffened::Bending => x / whole,
            };
            for of in [0, 3] {
                ends[of] += (1.0 - along) * q[of];
                ends[of + 6] += along * q[of];
            }
            for ((dofs, sign), bending, force, moment) in &planes {
                let [deflection, rotation] = bending.shapes(share);
                for (k, dof) in dofs.iter().enumerate() {
                    // About local 2 a rotation is a slope with the other sign, at the ends and where the load is.
                    let turned = if k % 2 == 1 { *sign } else { 1.0 };
                    ends[*dof] +=
                        turned * (deflection[k] * q[*force] + sign * rotation[k] * q[*moment]);
                }
            }
        });
        ends
    }

    /// What acts on the rigid lengths, at the nodes.
    fn on_rigid(&self, whole: f64, load: &SpanLoad, ends: &mut [f64; 12]) {
        // A point load at the very end of the member counts as well.
        let parts =
            [(0, [0.0, self.offset_i], 0.0), (6, [whole - self.offset_j, f64::INFINITY], whole)];
        for (node, between, origin) in parts {
            load.over(between, |x, q| {
                let arm = x - origin;
                match self.offsets_stiffen {
                    Stiffened::All => {
                        ends[node] += q[0];
                        ends[node + 3] += q[3];
                    }
                    Stiffened::Bending => {
                        let along = (x / whole).min(1.0);
                        for of in [0, 3] {
                            ends[of] += (1.0 - along) * q[of];
                            ends[of + 6] += along * q[of];
                        }
                    }
                }
                ends[node + 1] += q[1];
                ends[node + 2] += q[2];
                ends[node + 4] += q[4] - arm * q[2];
                ends[node + 5] += q[5] + arm * q[1];
            });
        }
    }

    /// What holds the ends of a beam that is warmed, reversed.
    fn warmth(
        &self,
        s: &Section,
        rise: f64,
        [along_2, along_3]: [f64; 2],
    ) -> Result<[f64; 12], ParameterError> {
        let Some(alpha) = self.expansion else {
            return Err(ParameterError::inconsistent(
                "expansion",
                "warmth needs the strain by one kelvin, `expansion`, or a `material`",
            ));
        };
        let mut ends = [0.0; 12];
        let axial = self.young * s.area * alpha * rise;
        let (about_3, about_2) =
            (self.young * s.i3 * alpha * along_2, self.young * s.i2 * alpha * along_3);
        for (node, sign) in [(0, -1.0), (6, 1.0)] {
            ends[node] = sign * axial;
            ends[node + 5] = -sign * about_3;
            ends[node + 4] = sign * about_2;
        }
        Ok(ends)
    }
}
