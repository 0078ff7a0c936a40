//! The models of the studies: those that are shipped, and a plane frame of any size.

use std::fmt::Write;

pub(super) const BLOCK: &str = include_str!("../../../models/rigid_block.ron");
pub(super) const DROP: &str = include_str!("../../../models/rigid_block_drop.ron");
pub(super) const ROCKING: &str = include_str!("../../../models/rigid_block_rocking.ron");
pub(super) const ISOLATED: &str = include_str!("../../../models/isolated_frame.ron");
pub(super) const POUNDING: &str = include_str!("../../../models/pounding_frames.ron");

/// A plane concrete frame on friction pendulums between two elastic stops.
pub(super) struct PlaneFrame {
    /// Bays of 6 m.
    pub bays: usize,
    /// Storeys of 3.3 m above the base level.
    pub storeys: usize,
    /// Elements of every column and beam.
    pub parts: usize,
}

impl PlaneFrame {
    /// The model text. Outputs: `base`, `roof`, drifts `drift1` …, and of some links.
    pub(super) fn text(&self) -> String {
        let mut nodes = String::new();
        let mut elements = String::new();
        let name = |i: usize, k: usize| format!("{i}-{k}");
        let place = |i: usize, k: usize| [6.0 * i as f64, 3.3 * k as f64];
        for k in 0..=self.storeys {
            for i in 0..=self.bays {
                let [x, z] = place(i, k);
                let at = name(i, k);
                let _ = writeln!(nodes, r#""{at}": ({x}, 0, {z}),"#);
                let _ = writeln!(elements, r#""mass {at}": Mass(node: "{at}", mass: "20 t"),"#);
                for (axis, to) in [("column", (i, k + 1)), ("beam", (i + 1, k))] {
                    if to.0 > self.bays || to.1 > self.storeys {
                        continue;
                    }
                    let [xj, zj] = place(to.0, to.1);
                    let mut from = at.clone();
                    for p in 1..=self.parts {
                        let share = p as f64 / self.parts as f64;
                        let mut end = format!("{axis} {at} {p}");
                        if p == self.parts {
                            end = name(to.0, to.1);
                        } else {
                            let (xp, zp) = (x + share * (xj - x), z + share * (zj - z));
                            let _ = writeln!(nodes, r#""{end}": ({xp}, 0, {zp}),"#);
                        }
                        let member = format!(r#"Beam(nodes: ("{from}", "{end}"), use: "{axis}")"#);
                        let _ = writeln!(elements, r#""{axis} {at}.{p}": {member},"#);
                        from = end;
                    }
                }
                if k == 0 {
                    let isolator = format!(r#"NLink(node: "{at}", use: "isolator")"#);
                    let _ = writeln!(elements, r#""isolator {i}": {isolator},"#);
                }
            }
        }
        let mut outputs = String::new();
        for k in 1..=self.storeys {
            let (above, below) = (name(0, k), name(0, k - 1));
            let term = |n: &str, f: i32| format!(r#"(node: "{n}", dof: Ux, factor: {f})"#);
            let terms = format!("({}, {})", term(&above, 1), term(&below, -1));
            let _ = writeln!(outputs, r#""drift{k}": Displacement(terms: {terms}),"#);
        }
        let (roof, right) = (name(0, self.storeys), name(self.bays, 0));
        format!(
            r#"(
            title: "Plane frame on friction pendulums between stops",
            plane: XZ,
            nodes: {{ {nodes} }},
            properties: {{
                "column": Beam(young: "30 GPa", poisson: 0.2, width: 0.7, depth: 0.7, density: 2500),
                "beam": Beam(young: "30 GPa", poisson: 0.2, width: 0.4, depth: 0.7, density: 2500),
                "isolator": NLink(kn: "1e9 N/m", ks: "20 MN/m", radius: 2,
                    mu_slow: 0.03, mu_fast: 0.06, rate: "50 s/m"),
            }},
            elements: {{ {elements}
                "stop left": Gap(node: "0-0", axis1: (1, 0, 0), axis2: (0, 0, 1),
                    k: "30 MN/m", opening: "12 cm"),
                "stop right": Gap(node: "{right}", axis1: (-1, 0, 0), axis2: (0, 0, 1),
                    k: "30 MN/m", opening: "12 cm"),
            }},
            damping: RayleighAt(ratio: 0.02, f1: "0.5 Hz", f2: "10 Hz"),
            functions: {{ "pulse": Ricker(amplitude: "0.3 g", frequency: "0.6 Hz", center: "1.5 s") }},
            cases: {{
                "gravity": Static(loads: [Gravity]),
                "pulse": Dynamic(
                    after: "gravity", duration: "3.3 s", dt: "5 ms",
                    base: [(direction: X, function: "pulse")],
                ),
            }},
            outputs: {{
                "base": Displacement(node: "0-0", dof: Ux),
                "roof": Displacement(node: "{roof}", dof: Ux),
                {outputs}
                "isolator_shear": LinkForce(link: "isolator 0", axis: U2),
                "isolator_compression": LinkForce(link: "isolator 0", axis: U1, factor: -1),
                "stop_left": LinkForce(link: "stop left", axis: U1, factor: -1),
                "stop_right": LinkForce(link: "stop right", axis: U1, factor: -1),
            }},
        )"#
        )
    }
}
