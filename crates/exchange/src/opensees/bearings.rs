//! Bearings: sliders, pendulums, rubber.

use super::args::{Args, Told, wrong};
use super::beams::{between, length};
use super::links::Place;
use super::materials::{Friction, Material};
use super::outputs::Written;
use super::recorder::Recorder;
use super::tcl::Value;
use crate::ron::Ron;

/// What bearings take behind their own parameters.
#[derive(Default)]
struct Tail {
    /// Along the axis, about it, about local y and z.
    materials: [Option<Material>; 4],
    missing: bool,
    axes: [[f64; 3]; 2],
    shear: Option<f64>,
    damped: bool,
    mass: f64,
}

impl Recorder<'_> {
    fn tail(&mut self, a: &mut Args<'_>, nodes: [usize; 2], share: f64) -> Told<Tail> {
        let mut out = Tail::default();
        let (mut orient, mut share) = ((0, Vec::new()), share);
        let mut given = [false; 4];
        while let Some(option) = a.option() {
            let which = ["-P", "-T", "-My", "-Mz"].iter().position(|k| *k == option);
            match (which, option) {
                (Some(k), _) => {
                    let word = a.at();
                    let tag = a.whole("a material")?;
                    out.materials[k] = self.material_of(word, tag)?;
                    out.missing |= out.materials[k].is_none();
                    given[k] = true;
                }
                (_, "-orient") => orient = (a.at(), a.all()),
                (_, "-shearDist") => share = a.number("the share of its length")?,
                (_, "-doRayleigh") => out.damped = a.maybe_whole().is_none_or(|x| x != 0),
                (_, "-mass") => out.mass = a.number("its mass")?,
                (_, "-iter") => {
                    let numbers = a.all();
                    self.ignore(
                        "-iter",
                        &format!(
                            "how its equations are solved is chosen here ({} numbers)",
                            numbers.len()
                        ),
                    );
                }
                (_, other) => self.unread(other),
            }
        }
        let needed: &[usize] = if self.ndm == 3 { &[0, 1, 2, 3] } else { &[0, 3] };
        if let Some(k) = needed.iter().find(|k| !given[**k]) {
            let name = ["-P", "-T", "-My", "-Mz"][*k];
            return wrong(
                0,
                format!("a bearing without its material {name}"),
                "-P material -T material -My material -Mz material",
            );
        }
        out.axes = self.axes(nodes, &orient.1, orient.0)?;
        let span = length(between(self.at(nodes[0]), self.at(nodes[1])));
        out.shear = (span > 0.0 && share != 1.0).then_some((1.0 - share) * span);
        if out.damped {
            self.lose("damping of its stiffness (-doRayleigh) is not written");
        }
        Ok(out)
    }

    /// Writes a bearing and what is linear beside it.
    fn bearing(
        &mut self,
        tag: i64,
        nodes: [usize; 2],
        block: Ron,
        tail: &Tail,
        axial: bool,
        tilt: Option<[f64; 2]>,
    ) {
        let name = format!("element {tag}");
        let mut written = Written { nodes, ..Written::default() };
        let fields = Ron::block("")
            .with("nodes", self.pair(nodes))
            .with("axis1", Ron::vector(&tail.axes[0]))
            .with("axis2", Ron::vector(&tail.axes[1]));
        let Ron::Block(_, placed) = &fields else { return };
        let mut own = placed.iter().fold(block, |b, (k, v)| b.with(k, v.clone()));
        own = own.maybe("shear_at", tail.shear).maybe("p_delta_at", tilt.map(|t| Ron::vector(&t)));
        self.draft.elements.push((name.clone(), own));
        let axes: &[usize] = if axial { &[1, 2] } else { &[0, 1, 2] };
        written.links.extend(axes.iter().map(|k| (name.clone(), *k)));
        let (mut k, mut c) = ([0.0; 6], [0.0; 6]);
        for (at, what, axis) in [(0, "-P", 0), (1, "-T", 3), (2, "-My", 4), (3, "-Mz", 5)] {
            if at == 0 && !axial || self.ndm < 3 && (at == 1 || at == 2) {
                continue;
            }
            let nonlinear =
                at == 0 && tail.materials[0].as_ref().is_some_and(|m| m.linear().is_none());
            if nonlinear {
                let material = tail.materials[0].clone().unwrap_or_default();
                let laws: Vec<_> = material.laws.iter().map(|l| (l, 1.0, 1.0)).collect();
                self.write_laws(&name, 0, &laws, &fields, false, &mut written);
                continue;
            }
            let (stiffness, damping) = self.linear_of(tail.materials[at].as_ref(), what);
            k[axis] += stiffness;
            c[axis] += damping;
        }
        let place =
            Place { name: format!("{name} linear"), fields, shear: None, damped: tail.damped };
        self.write_linear(&place, k, c, &mut written);
        for node in nodes {
            self.nodes[node].brought += tail.mass / 2.0;
        }
        self.elements.insert(tag, written);
        self.changed();
    }

    fn friction_of(&mut self, a: &mut Args<'_>) -> Told<Option<Friction>> {
        let word = a.at();
        let tag = a.whole("its friction model")?;
        match self.frictions.get(&tag) {
            Some(friction) => Ok(friction.clone()),
            None => wrong(
                word,
                format!("there is no friction model {tag}"),
                "`frictionModel` stands before what uses it",
            ),
        }
    }

    pub(super) fn sliding(&mut self, words: &[Value], pendulum: bool) -> Told<()> {
        let usage = if pendulum {
            "element singleFPBearing tag i j friction Reff kInit -P m -Mz m"
        } else {
            "element flatSliderBearing tag i j friction kInit -P m -Mz m"
        };
        let mut a = Args::new(words, 2, usage);
        let (tag, nodes) = self.placed(&mut a)?;
        let friction = self.friction_of(&mut a)?;
        let radius = if pendulum { Some(a.positive("its effective radius")?) } else { None };
        let ks = a.positive("its stiffness before slip")?;
        let tail = self.tail(&mut a, nodes, 0.0)?;
        let axial = tail.materials[0].as_ref().and_then(Material::compression);
        let (Some(friction), Some((kn, damping)), false) = (friction, axial, tail.missing) else {
            self.lost("its friction model or a material of it was lost, or that of -P is not linear in compression");
            return Ok(());
        };
        let mut block = Ron::block("FrictionPendulum").with("kn", kn).with("ks", ks);
        if damping != 0.0 {
            block = block.with("damping", damping).with("pull", Ron::word("true"));
        }
        if let Some(radius) = radius {
            block = block.with("radius", radius).with("surface", Ron::word("Spherical"));
            self.otherwise("before slip its stiffness is kInit and N/Reff here, kInit there; N takes no share of the shear over the slope here");
        }
        block = friction.fields.iter().fold(block, |b, (k, v)| b.with(k, v.clone()));
        self.bearing(tag, nodes, block, &tail, false, Some([1.0, 0.0]));
        Ok(())
    }

    pub(super) fn rubber(&mut self, words: &[Value], smooth: bool) -> Told<()> {
        let mut a = Args::new(
            words,
            2,
            "element elastomericBearingPlasticity tag i j kInit qd alpha1 alpha2 mu -P m -Mz m",
        );
        let (tag, nodes) = self.placed(&mut a)?;
        let (k, qd) = (a.positive("kInit")?, a.positive("qd")?);
        let word = a.at();
        let [ratio, second, power] = a.numbers::<3>("alpha1, alpha2, mu")?;
        if !(0.0..1.0).contains(&ratio) {
            return wrong(word, format!("a ratio alpha1 of {ratio}"), "from 0 to below 1");
        }
        if second != 0.0 {
            self.lose(&format!(
                "its part that grows with the power {power} (alpha2) is not written"
            ));
        }
        let fy = qd / (1.0 - ratio);
        let shape =
            if smooth { [1.0, 0.5, 0.5].map(|d| a.maybe().unwrap_or(d)) } else { [1.0, 0.5, 0.5] };
        let tail = self.tail(&mut a, nodes, 0.5)?;
        if tail.missing {
            self.lost("a material of it was lost");
            return Ok(());
        }
        let axial = tail.materials[0].as_ref().and_then(Material::linear).filter(|l| l.1 == 0.0);
        match (smooth, axial) {
            (true, Some((kv, _))) => {
                let block = smooth_block(k, fy, ratio, shape).with("kv", kv);
                self.bearing(tag, nodes, block, &tail, false, Some([0.5, 0.5]));
            }
            _ => {
                let block = if smooth {
                    smooth_block(k, fy, ratio, shape)
                } else {
                    Ron::block("ElastomericBearing")
                        .with("k", k)
                        .with("fy", fy)
                        .with("ratio", ratio)
                };
                self.otherwise("moments of its axial force over its shear (P-Δ) are not there");
                self.bearing(tag, nodes, block, &tail, true, None);
            }
        }
        Ok(())
    }

    pub(super) fn triple(&mut self, words: &[Value]) -> Told<()> {
        let usage = "element TripleFrictionPendulum tag i j frn1 frn2 frn3 vert rotZ rotX rotY L1 L2 L3 d1 d2 d3 W uy kvt minFv tol";
        let mut a = Args::new(words, 2, usage);
        let (tag, nodes) = self.placed(&mut a)?;
        let mut mu = [None; 3];
        for m in &mut mu {
            *m = self.friction_of(&mut a)?.and_then(|f| f.coulomb);
        }
        let mut tail =
            Tail { axes: self.axes(nodes, &[0.0, 0.0, 1.0, 1.0, 0.0, 0.0], 0)?, ..Tail::default() };
        // Behind the vertical one: about the vertical axis, then about X and Y, which are local y and −z here.
        for at in [0, 1, 2, 3] {
            let word = a.at();
            let material = a.whole("a material")?;
            tail.materials[at] = self.material_of(word, material)?;
            tail.missing |= tail.materials[at].is_none();
        }
        let [l1, l2, l3, d1, d2, d3, w, uy] = a.numbers::<8>("L1, L2, L3, d1, d2, d3, W, uy")?;
        let rest = a.all();
        self.ignore(
            "kvt minFv tol",
            &format!("tension and iterations are not those of this link ({} numbers)", rest.len()),
        );
        let kn = tail.materials[0].as_ref().and_then(Material::compression);
        let ([Some(mu1), Some(mu2), Some(mu3)], Some((kn, _)), false, 3) =
            (mu, kn, tail.missing, self.ndm)
        else {
            self.lost(
                "its friction is not Coulomb's, or a material of it was lost or is not linear",
            );
            return Ok(());
        };
        if uy <= 0.0 || w <= 0.0 || mu1 <= 0.0 {
            return wrong(0, "a bearing whose W, uy or first friction is not above zero", usage);
        }
        let ks = 4.0 * mu1 * w / uy;
        let block = Ron::block("TriplePendulum")
            .with("kn", kn)
            .with("ks", ks)
            .with("radii", Ron::vector(&[l2, l1, l1, l3]))
            .with("capacities", Ron::vector(&[d2, d1, d1, d3]))
            .with("stop_stiffness", ks)
            .with("mu", Ron::vector(&[mu2, mu1, mu1, mu3]));
        self.otherwise("four surfaces in series: the stretch before slip is shared out otherwise, rims are as stiff as that");
        self.bearing(tag, nodes, block, &tail, false, Some([0.5, 0.5]));
        Ok(())
    }
}

/// A bearing after Bouc and Wen: stiffness, yield force, ratio; η, β, γ.
fn smooth_block(k: f64, fy: f64, ratio: f64, [eta, beta, gamma]: [f64; 3]) -> Ron {
    Ron::block("RubberIsolator")
        .with("k2", k)
        .with("fy2", fy)
        .with("ratio2", ratio)
        .with("coupling", Ron::word("Direction"))
        .with("eta", eta)
        .with("beta", beta)
        .with("gamma", gamma)
}
