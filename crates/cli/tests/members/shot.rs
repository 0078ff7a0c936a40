//! A beam between two ends, integrated: w′ = θ + V/(GA), θ′ = M/(EI) + κ, M′ = −V… by Runge and Kutta's rule of fourth
//! order, with what holds its ends found by shooting. It knows nothing of shape functions.

/// The beam.
pub struct Shot {
    pub ei: f64,
    pub ga: f64,
    pub l: f64,
    /// Force and moment by length, where they are.
    pub q: fn(f64) -> f64,
    /// Curvature where nothing holds it.
    pub kappa: f64,
    /// Points: place, force.
    pub points: Vec<(f64, f64)>,
}

impl Shot {
    /// (w, θ, M, V) along the beam from a start; V, M: inside, on the face that looks along the beam, turning from w to θ
    /// by the right hand.
    pub fn fly(&self, start: [f64; 4], to: f64) -> [f64; 4] {
        let slope = |x: f64, [_, turn, m, v]: [f64; 4]| {
            // w′ = θ + γ, θ′ = M/EI + κ, V′ = −q, M′ = −V
            [turn + v / self.ga, m / self.ei + self.kappa, -v, -(self.q)(x)]
        };
        let mut y = start;
        let mut x = 0.0;
        // Loads begin and end at sixteenths of the length.
        let mut stops: Vec<f64> = (1..=16).map(|i| f64::from(i) / 16.0 * self.l).collect();
        stops.extend(self.points.iter().map(|p| p.0));
        stops.push(to);
        stops.retain(|s| *s <= to);
        stops.sort_by(f64::total_cmp);
        stops.dedup();
        for stop in stops {
            let n = 40;
            let h = (stop - x) / f64::from(n);
            for _ in 0..n {
                let at = |y: [f64; 4], k: [f64; 4], s: f64| -> [f64; 4] {
                    std::array::from_fn(|i| y[i] + s * k[i])
                };
                // Halves of a step lie inside of it: loads jump between steps.
                let inside = |x: f64| x.clamp(1e-12 * self.l, self.l * (1.0 - 1e-12));
                let k1 = slope(inside(x + 1e-9 * h), y);
                let k2 = slope(inside(x + 0.5 * h), at(y, k1, 0.5 * h));
                let k3 = slope(inside(x + 0.5 * h), at(y, k2, 0.5 * h));
                let k4 = slope(inside(x + h - 1e-9 * h), at(y, k3, h));
                y = std::array::from_fn(|i| {
                    y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i])
                });
                x += h;
            }
            x = stop;
            if stop < to {
                for (_, force) in self.points.iter().filter(|p| p.0 == stop) {
                    y[3] -= force;
                }
            }
        }
        y
    }

    /// The start of a beam that is clamped at the first end, and at the other clamped or hinged.
    pub fn clamped(&self, hinged: bool) -> [f64; 4] {
        let end = |m: f64, v: f64| {
            let y = self.fly([0.0, 0.0, m, v], self.l);
            [y[0], if hinged { y[2] } else { y[1] }]
        };
        let (o, a, b) = (end(0.0, 0.0), end(1.0, 0.0), end(0.0, 1.0));
        let [[a0, a1], [b0, b1]] = [a, b].map(|c| [c[0] - o[0], c[1] - o[1]]);
        let det = a0 * b1 - b0 * a1;
        [0.0, 0.0, (-o[0] * b1 + b0 * o[1]) / det, (-a0 * o[1] + a1 * o[0]) / det]
    }
}
