//! A frame as a model file.

use super::{Frame, Section, synthetic};
use std::fmt::{self, Write};

/// Where a joint lies in plan: its share of floor and weight.
const PLACES: [&str; 3] = ["corner", "edge", "inside"];

impl Frame {
    fn place_in_plan(&self, i: usize, j: usize) -> usize {
        usize::from(i > 0 && i < self.bays[0]) + usize::from(j > 0 && j < self.bays[1])
    }

    /// One joint of each place in plan that there is.
    fn places(&self) -> Vec<(usize, [usize; 2])> {
        let [x, y] = self.bays;
        let edge = if x > 1 { [1, 0] } else { [0, 1] };
        let mut all = vec![(0, [0, 0])];
        if x > 1 || y > 1 {
            all.push((1, edge));
        }
        if x > 1 && y > 1 {
            all.push((2, [1, 1]));
        }
        all
    }

    /// The model file. Quantities that one may want to change are parameters.
    #[must_use]
    pub fn to_ron(&self) -> String {
        // A line is about 70 bytes; the records dwarf a small frame.
        let mut text = String::with_capacity(80 * (self.elements() + 2 * self.nodes()) + 400_000);
        // Writing to a string does not fail.
        let _ = self.write(&mut text);
        text
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        self.head(out)?;
        self.nodes_to(out)?;
        self.properties(out)?;
        self.elements_to(out)?;
        self.functions(out)?;
        self.case_and_outputs(out)
    }

    fn head(&self, out: &mut String) -> fmt::Result {
        let [x, y] = self.bays;
        let plural =
            |n: usize, one: &str| if n == 1 { format!("1 {one}") } else { format!("{n} {one}s") };
        writeln!(
            out,
            "\
// Base-isolated moment frame: {x} by {y} bays of {} m, {} of {} m, every member {}.
// {} nodes, {} beams, {} isolators, {} t. Made by `trilith generate frame`.
//
// Joint \"i j k\" is at grid lines i along X and j along Y on level k; level 0 lies on the isolators. A column
// \"z i j k\" rises from it, beams \"x i j k\" and \"y i j k\" leave it along X and Y. A member of several parts
// has nodes \"z i j k 1\", \"z i j k 2\" … between its ends. Beams are Euler–Bernoulli, masses are lumped and have no
// rotary inertia. Isolator n is under the n-th joint of level 0, i running first: a pendulum spring W/R, a
// vertical spring, and a bearing that slips at μW, with W its share of the weight by floor area. The bearings
// and the two dampers at the edges are links; Rayleigh damping acts on everything else, springs included.
// Units: SI.",
            self.bay,
            plural(self.storeys, "storey"),
            self.storey,
            if self.cuts == 1 { "one element".to_owned() } else { format!("of {} elements", self.cuts) },
            self.nodes(),
            self.elements(),
            self.isolators(),
            (self.mass() / 1e3).round(),
        )?;
        writeln!(out, "(")?;
        writeln!(
            out,
            "    title: \"Base-isolated frame, {x} by {y} bays, {}\",",
            plural(self.storeys, "storey")
        )?;
        writeln!(out, "    parameters: {{")?;
        let mut parameter = |name: &str, value: String, meaning: &str| {
            writeln!(out, "        {:35} // {meaning}", format!("\"{name}\": {value},"))
        };
        parameter("mu", self.mu.to_string(), "friction coefficient of the isolators")?;
        parameter("radius", format!("\"{} m\"", self.radius), "of their pendulums")?;
        parameter("slip", format!("\"{} m\"", self.slip), "deformation at which they slip")?;
        parameter("sag", format!("\"{} m\"", self.sag), "shortening under their weight")?;
        for (place, [i, j]) in self.places() {
            let weight = format!("\"{} N\"", self.weight(i, j));
            parameter(PLACES[place], weight, "weight on an isolator")?;
        }
        let damper = format!("\"{} N*s/m\"", self.damper());
        parameter("damper", damper, "each of the two dampers")?;
        writeln!(out, "    }},")
    }

    fn nodes_to(&self, out: &mut String) -> fmt::Result {
        writeln!(out, "    nodes: {{")?;
        for at in self.all_joints() {
            let [x, y, z] = self.place(at);
            writeln!(out, "        \"{at}\": ({x}, {y}, {z}),")?;
        }
        for member in self.all_members() {
            let (a, b) = (self.place(member.start), self.place(member.end));
            for cut in 1..self.cuts {
                let share = |x: usize| a[x] + (b[x] - a[x]) * cut as f64 / self.cuts as f64;
                let [x, y, z] = [share(0), share(1), share(2)];
                writeln!(out, "        \"{}\": ({x}, {y}, {z}),", member.node(cut, self.cuts))?;
            }
        }
        writeln!(out, "    }},")
    }

    fn properties(&self, out: &mut String) -> fmt::Result {
        writeln!(out, "    properties: {{")?;
        let sections =
            [("column", self.column), ("beam", self.beam), ("base beam", self.base_beam)];
        for (name, Section { width, depth }) in sections {
            writeln!(
                out,
                "        \"{name}\": Beam(young: \"{} GPa\", poisson: {}, width: \"{width} m\", depth: \"{depth} m\", density: \"{} kg/m^3\"),",
                self.young / 1e9,
                self.poisson,
                self.density,
            )?;
        }
        for (place, [i, j]) in self.places() {
            let (name, area) = (PLACES[place], self.area(i, j));
            writeln!(
                out,
                "        \"base {name}\": Mass(mass: \"{} kg\"),",
                self.base_floor * area
            )?;
            writeln!(out, "        \"floor {name}\": Mass(mass: \"{} kg\"),", self.floor * area)?;
            writeln!(
                out,
                "        \"spring {name}\": Spring(k1: \"{name}/sag\", k2: \"{name}/radius\", k3: \"{name}/radius\"),"
            )?;
            writeln!(
                out,
                "        \"bearing {name}\": ElastomericBearing(k: \"mu*{name}/slip\", fy: \"mu*{name}\", ratio: 0),"
            )?;
        }
        writeln!(out, "    }},")
    }

    fn elements_to(&self, out: &mut String) -> fmt::Result {
        writeln!(out, "    elements: {{")?;
        for member in self.all_members() {
            for cut in 0..self.cuts {
                writeln!(
                    out,
                    "        \"{}\": Beam(nodes: (\"{}\", \"{}\"), use: \"{}\"),",
                    member.name(cut, self.cuts),
                    member.node(cut, self.cuts),
                    member.node(cut + 1, self.cuts),
                    member.section.name(),
                )?;
            }
        }
        for at in self.all_joints() {
            let place = PLACES[self.place_in_plan(at.i, at.j)];
            let level = if at.k == 0 { "base" } else { "floor" };
            writeln!(
                out,
                "        \"mass {at}\": Mass(node: \"{at}\", use: \"{level} {place}\"),"
            )?;
        }
        for (n, at) in self.all_joints().take(self.isolators()).enumerate() {
            let place = PLACES[self.place_in_plan(at.i, at.j)];
            writeln!(
                out,
                "        \"spring {n}\": Spring(node: \"{at}\", use: \"spring {place}\"),"
            )?;
            writeln!(
                out,
                "        \"bearing {n}\": ElastomericBearing(node: \"{at}\", use: \"bearing {place}\"),"
            )?;
        }
        let [x, y] = self.bays.map(|n| n / 2);
        writeln!(
            out,
            "        \"damper x\": Dashpot(node: \"{x} 0 0\", c: \"damper\", axis: U2),"
        )?;
        writeln!(
            out,
            "        \"damper y\": Dashpot(node: \"0 {y} 0\", c: \"damper\", axis: U3),"
        )?;
        writeln!(out, "    }},")
    }

    fn functions(&self, out: &mut String) -> fmt::Result {
        let [f1, f2] = self.frequencies;
        writeln!(
            out,
            "    damping: RayleighAt(ratio: {}, f1: \"{f1} Hz\", f2: \"{f2} Hz\"),",
            self.damping
        )?;
        writeln!(
            out,
            "    // (s, m/s²): 240 sines from 0.2 to 24.1 Hz with a Clough–Penzien spectrum"
        )?;
        writeln!(out, "    functions: {{")?;
        for (component, name) in ["x", "y"].into_iter().enumerate() {
            writeln!(out, "        \"record {name}\": Points(after_end: Zero, points: [")?;
            let record = synthetic(component, self.dt, self.duration, self.peak[component]);
            for (line, values) in record.chunks(4).enumerate() {
                write!(out, "           ")?;
                for (i, a) in values.iter().enumerate() {
                    // Without the rounding of a product.
                    let t = ((4 * line + i) as f64 * self.dt * 1e9).round() / 1e9;
                    write!(out, " ({t}, {a}),")?;
                }
                writeln!(out)?;
            }
            writeln!(out, "        ]),")?;
        }
        writeln!(out, "    }},")
    }

    fn case_and_outputs(&self, out: &mut String) -> fmt::Result {
        let basis = match self.vectors {
            // No vector for the links: the ground motion brings theirs along.
            Some(n) => {
                format!("\n            basis: Ritz(vectors: {n}, adequacy: 0, tolerance: 1),")
            }
            None => String::new(),
        };
        let tolerance = match self.link_tolerance {
            Some(share) => format!(" link_tolerance: {share:?},"),
            None => String::new(),
        };
        writeln!(
            out,
            "    cases: {{
        \"earthquake\": Dynamic(
            duration: \"{} s\", dt: \"{} s\", step: Fixed(substeps: 1),{tolerance}
            base: [(direction: X, function: \"record x\"), (direction: Y, function: \"record y\")],{basis}
        ),
    }},
    outputs: {{",
            self.duration, self.dt,
        )?;
        for (axis, dof) in [("x", "Ux"), ("y", "Uy")] {
            writeln!(
                out,
                "        \"roof_{axis}\": Displacement(terms: [(node: \"0 0 {}\", dof: {dof}), (node: \"0 0 0\", dof: {dof}, factor: -1)]),",
                self.storeys
            )?;
        }
        for n in 0..self.isolators() {
            for (axis, local) in [("x", "U2"), ("y", "U3")] {
                writeln!(
                    out,
                    "        \"iso {n} {axis}\": LinkDeformation(link: \"bearing {n}\", axis: {local}),"
                )?;
            }
        }
        writeln!(out, "    }},\n)")
    }
}
