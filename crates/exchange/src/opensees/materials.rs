//! Uniaxial materials and friction models as laws of links.

use super::args::{Args, Told, wrong};
use super::recorder::Recorder;
use super::tcl::Value;
use crate::ron::Ron;

/// A law in one direction.
#[derive(Clone, Debug)]
pub enum Law {
    Elastic {
        k: f64,
        c: f64,
    },
    /// A curve through points: elastic, or kinematic plastic.
    Curve {
        plastic: bool,
        points: Vec<[f64; 2]>,
    },
    Gap {
        k: f64,
        opening: f64,
    },
    Hook {
        k: f64,
        opening: f64,
    },
    Kelvin {
        k: f64,
        c: f64,
        opening: f64,
    },
    Hertz {
        model: &'static str,
        k: f64,
        xi: f64,
        mass: Option<f64>,
        opening: f64,
        exponent: f64,
    },
    Dashpot {
        c: f64,
        exponent: f64,
    },
    Maxwell {
        k: f64,
        c: f64,
        exponent: f64,
    },
    Oil {
        k: f64,
        c: f64,
        cy: f64,
        fl: f64,
    },
    BoucWen {
        k: f64,
        alpha: f64,
        n: f64,
        beta: f64,
        gamma: f64,
        a0: f64,
        losses: [f64; 3],
    },
}

/// Laws that act side by side.
#[derive(Clone, Debug, Default)]
pub struct Material {
    pub laws: Vec<Law>,
}

impl Material {
    fn one(law: Law) -> Self {
        Self { laws: vec![law] }
    }

    /// Stiffness and damping where it is linear.
    pub fn linear(&self) -> Option<(f64, f64)> {
        let mut sum = (0.0, 0.0);
        for law in &self.laws {
            match law {
                Law::Elastic { k, c } => sum = (sum.0 + k, sum.1 + c),
                Law::Dashpot { c, exponent } if *exponent == 1.0 => sum.1 += c,
                _ => return None,
            }
        }
        Some(sum)
    }

    /// Stiffness in compression where that is linear.
    pub fn compression(&self) -> Option<(f64, f64)> {
        match self.laws.as_slice() {
            [Law::Gap { k, opening: 0.0 }] => Some((*k, 0.0)),
            _ => self.linear().filter(|l| l.0 > 0.0),
        }
    }
}

impl Law {
    /// The kind with its parameters, for forces times `force` of deformations times `length`; none where a rotation
    /// has no such kind.
    pub fn block(&self, force: f64, length: f64, turn: bool) -> Option<Ron> {
        let stiff = force / length;
        let points = |points: &[[f64; 2]], i: usize, by: f64| {
            Ron::List(points.iter().map(|p| Ron::Number(p[i] * by)).collect())
        };
        let straight_only = matches!(
            self,
            Law::Gap { .. }
                | Law::Hook { .. }
                | Law::Kelvin { .. }
                | Law::Hertz { .. }
                | Law::Maxwell { .. }
                | Law::Oil { .. }
        );
        if turn && straight_only {
            return None;
        }
        Some(match self {
            Law::Elastic { .. } => return None,
            Law::Curve { plastic, points: all } => {
                let kind = if *plastic { "MultilinearPlastic" } else { "MultilinearElastic" };
                let block = Ron::block(kind)
                    .with("deformation", points(all, 0, length))
                    .with("force", points(all, 1, force));
                if *plastic { block.with("rule", Ron::word("Kinematic")) } else { block }
            }
            Law::Gap { k, opening } => {
                Ron::block("Gap").with("k", k * stiff).with("opening", opening * length)
            }
            Law::Hook { k, opening } => {
                Ron::block("Hook").with("k", k * stiff).with("opening", opening * length)
            }
            Law::Kelvin { k: 0.0, c, opening } => Ron::block("Dashpot")
                .with("c", c * stiff)
                .with("when", Ron::word("InContact"))
                .with("opening", opening * length)
                .with("pull", Ron::word("true")),
            Law::Kelvin { k, c, opening } => Ron::block("ImpactKelvin")
                .with("k", k * stiff)
                .with("damping", c * stiff)
                .with("opening", opening * length)
                .with("pull", Ron::word("true")),
            Law::Hertz { model, k, xi, mass, opening, exponent } => Ron::block("ImpactHertz")
                .with("model", Ron::word(*model))
                .with("k", k * force / length.powf(*exponent))
                .with("exponent", *exponent)
                .with("xi", *xi)
                .maybe("impact_mass", *mass)
                .with("opening", opening * length),
            Law::Dashpot { c, exponent } => Ron::block("Dashpot")
                .with(if turn { "cr" } else { "c" }, c * force / length.powf(*exponent))
                .with("exponent", *exponent),
            Law::Maxwell { k, c, exponent } => Ron::block("MaxwellDamper")
                .with("k", k * stiff)
                .with("c", c * force / length.powf(*exponent))
                .with("exponent", *exponent),
            Law::Oil { k, c, cy, fl } => Ron::block("BilinearDamper")
                .with("k", k * stiff)
                .with("c", c * stiff)
                .with("cy", cy * stiff)
                .with("fl", fl * force),
            Law::BoucWen { k, alpha, n, beta, gamma, a0, losses } => {
                let energy = (1.0 - alpha) * k;
                let names = ["delta_a", "delta_nu", "delta_eta"];
                let block = Ron::block("BoucWen")
                    .with("k", k * stiff)
                    .with("dy", length)
                    .with("alpha", *alpha)
                    .with("n", *n)
                    .with("beta", *beta)
                    .with("gamma", *gamma)
                    .with("a0", *a0);
                names.iter().zip(losses).fold(block, |b, (name, loss)| {
                    b.maybe(name, (*loss != 0.0).then_some(loss * energy))
                })
            }
        })
    }
}

/// A friction model: fields of a bearing.
#[derive(Clone, Debug)]
pub struct Friction {
    pub fields: Vec<(&'static str, Ron)>,
    /// The coefficient of a slider that does not depend on anything.
    pub coulomb: Option<f64>,
}

/// Both sides of a plastic curve: first line, then one with a share of its slope.
fn bilinear(fy: f64, e: f64, b: f64) -> Law {
    let (d, far) = (fy / e, 100.0 * fy / e);
    let f = fy + b * e * (far - d);
    Law::Curve { plastic: true, points: vec![[-far, -f], [-d, -fy], [0.0, 0.0], [d, fy], [far, f]] }
}

impl Recorder<'_> {
    pub(super) fn material(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "uniaxialMaterial type tag …");
        let kind = a.word("its type")?;
        let tag = a.whole("its tag")?;
        if self.materials.contains_key(&tag) {
            return wrong(
                2,
                format!("there are two materials {tag}"),
                "every material has a tag of its own",
            );
        }
        let material = self.law(kind, &mut a)?;
        if material.is_some() {
            while let Some(more) = a.option() {
                self.unread(more);
            }
        } else {
            self.lost("this material has no counterpart");
        }
        self.materials.insert(tag, material);
        Ok(())
    }

    fn law(&mut self, kind: &str, a: &mut Args<'_>) -> Told<Option<Material>> {
        let law = match kind {
            "Elastic" => {
                let k = a.number("E")?;
                let c = a.maybe().unwrap_or(0.0);
                match a.maybe() {
                    Some(other) if other != k => {
                        let mut all = vec![Law::Curve {
                            plastic: false,
                            points: vec![[-1.0, -other], [0.0, 0.0], [1.0, k]],
                        }];
                        if c != 0.0 {
                            all.push(Law::Dashpot { c, exponent: 1.0 });
                        }
                        return Ok(Some(Material { laws: all }));
                    }
                    _ => Law::Elastic { k, c },
                }
            }
            "ElasticPP" => {
                let (e, d) = (a.positive("E")?, a.number("epsyP")?.abs());
                if a.maybe().is_some_and(|n| n.abs() != d) || a.maybe().is_some_and(|x| x != 0.0) {
                    self.lose("other limits in compression and an initial strain are not read: both sides are alike");
                }
                bilinear(e * d, e, 0.0)
            }
            "Steel01" => {
                let (fy, e, b) = (a.positive("Fy")?, a.positive("E")?, a.number("b")?);
                let hardening: Vec<f64> = a.all();
                // a1 and a3 are zero where nothing hardens.
                if [0, 2].iter().any(|k| hardening.get(*k).is_some_and(|x| *x != 0.0)) {
                    self.lose("isotropic hardening (a1 … a4) is not read");
                }
                bilinear(fy, e, b)
            }
            "Hardening" => {
                let [e, fy, iso, kin] = a.numbers::<4>("E, sigmaY, Hiso, Hkin")?;
                if iso != 0.0 || e <= 0.0 || fy <= 0.0 {
                    return Ok(None);
                }
                bilinear(fy, e, kin / (e + kin))
            }
            "ENT" => Law::Gap { k: a.positive("E")?, opening: 0.0 },
            "ElasticPPGap" => {
                let (k, fy, gap) = (a.positive("E")?, a.number("Fy")?, a.number("gap")?);
                let more = a.option();
                if a.maybe().is_some_and(|eta| eta != 0.0)
                    || more.is_some_and(|m| m != "0" && m != "noDamage")
                {
                    self.lose("hardening and damage of the gap are not read");
                }
                self.otherwise(&format!(
                    "the gap stays elastic: equal until its force reaches {fy}"
                ));
                if fy < 0.0 { Law::Gap { k, opening: -gap } } else { Law::Hook { k, opening: gap } }
            }
            "HookGap" => {
                let (k, first) = (a.positive("E")?, a.number("gap")?);
                let (negative, positive) = match a.maybe() {
                    Some(second) => (first, second),
                    None => (-first, first),
                };
                let laws =
                    vec![Law::Gap { k, opening: -negative }, Law::Hook { k, opening: positive }];
                return Ok(Some(Material { laws }));
            }
            "ViscoelasticGap" => {
                let [k, c, gap] = a.numbers::<3>("K, C, gap")?;
                Law::Kelvin { k, c, opening: -gap }
            }
            "Hertzdamp" | "HertzDamp" => {
                let [k, xi, gap] = a.numbers::<3>("Kh, xiNorm, gap")?;
                let exponent = a.maybe().unwrap_or(1.5);
                Law::Hertz { model: "Hertzdamp", k, xi, mass: None, opening: -gap, exponent }
            }
            "JankowskiImpact" => {
                let [k, xi, mass, gap] = a.numbers::<4>("Kh, xi, Meff, gap")?;
                let exponent = a.maybe().unwrap_or(1.5);
                Law::Hertz { model: "Jankowski", k, xi, mass: Some(mass), opening: -gap, exponent }
            }
            "Viscous" => {
                let (c, exponent) = (a.positive("C")?, a.positive("alpha")?);
                if let Some(least) = a.maybe() {
                    self.ignore("minVel", &format!("below {least} there, `linear_below` here, the force is linear in the rate"));
                }
                Law::Dashpot { c, exponent }
            }
            "ViscousDamper" => {
                let [k, c, exponent] = a.numbers::<3>("K, Cd, alpha")?;
                self.rest_of_damper(a);
                Law::Maxwell { k, c, exponent }
            }
            "Maxwell" => {
                let [k, c, alpha, length] = a.numbers::<4>("K, C, alpha, length")?;
                if a.flag("-returnD") {
                    self.ignore("-returnD", "what it returns changes no force");
                }
                Law::Maxwell { k, c: c / length.powf(alpha), exponent: 1.0 }
            }
            "BilinearOilDamper" => {
                let [k, c] = a.numbers::<2>("K, Cd")?;
                let (fr, p) = (a.maybe().unwrap_or(1.0), a.maybe().unwrap_or(1.0));
                self.rest_of_damper(a);
                Law::Oil { k, c, cy: p * c, fl: fr }
            }
            "BoucWen" => {
                let [alpha, k, n, gamma, beta, a0] =
                    a.numbers::<6>("alpha, ko, n, gamma, beta, Ao")?;
                let losses = a.numbers::<3>("deltaA, deltaNu, deltaEta")?;
                let numerics: Vec<f64> = a.all();
                if !numerics.is_empty() {
                    self.ignore("tol maxIter", "how its equation is solved is chosen here");
                }
                Law::BoucWen { k, alpha, n, beta, gamma, a0, losses }
            }
            "MultiLinear" => {
                let all = a.all();
                let Some(points) = sided(&all) else { return Ok(None) };
                Law::Curve { plastic: true, points }
            }
            "ElasticMultiLinear" => {
                let eta = a.maybe().unwrap_or(0.0);
                let (mut strain, mut stress) = (Vec::new(), Vec::new());
                while let Some(option) = a.option() {
                    match option {
                        "-strain" => strain = a.all(),
                        "-stress" => stress = a.all(),
                        other => self.unread(other),
                    }
                }
                let rising = strain.windows(2).all(|w| w[0] < w[1]);
                if strain.len() != stress.len() || strain.len() < 2 || !rising {
                    return wrong(
                        0,
                        "`ElasticMultiLinear` without pairs of rising strains and stresses",
                        "-strain … -stress …",
                    );
                }
                let points = strain.iter().zip(&stress).map(|(a, b)| [*a, *b]).collect();
                let mut laws = vec![Law::Curve { plastic: false, points }];
                if eta != 0.0 {
                    laws.push(Law::Dashpot { c: eta, exponent: 1.0 });
                }
                return Ok(Some(Material { laws }));
            }
            "Parallel" => {
                let mut laws = Vec::new();
                while a.peek().is_some_and(|w| w != "-factors") {
                    let word = a.at();
                    let other = a.whole("a material")?;
                    match self.material_of(word, other)? {
                        Some(m) => laws.extend(m.laws),
                        None => return Ok(None),
                    }
                }
                return Ok(if a.peek().is_some() { None } else { Some(Material { laws }) });
            }
            _ => return Ok(None),
        };
        Ok(Some(Material::one(law)))
    }

    /// Play and settings of its own equation, behind the constants of a damper.
    fn rest_of_damper(&mut self, a: &mut Args<'_>) {
        if a.maybe().is_some_and(|gap| gap != 0.0) {
            self.lose("the play LGap is not read");
        }
        if !a.all().is_empty() {
            self.ignore("NM RelTol AbsTol MaxHalf", "how its equation is solved is chosen here");
        }
    }

    /// The material of a tag at a word; none where it was lost.
    pub(super) fn material_of(&self, word: usize, tag: i64) -> Told<Option<Material>> {
        match self.materials.get(&tag) {
            Some(material) => Ok(material.clone()),
            None => wrong(
                word,
                format!("there is no material {tag}"),
                "materials stand before what uses them",
            ),
        }
    }

    pub(super) fn friction(&mut self, words: &[Value]) -> Told<()> {
        let mut a = Args::new(words, 1, "frictionModel Coulomb tag mu");
        let kind = a.word("its type")?;
        let tag = a.whole("its tag")?;
        let mut coulomb = None;
        let fields: Vec<(&str, Ron)> = match kind {
            "Coulomb" => {
                let mu = a.number("mu")?;
                coulomb = Some(mu);
                vec![("mu", mu.into())]
            }
            "VelDependent" => {
                let [slow, fast, rate] = a.numbers::<3>("muSlow, muFast, transRate")?;
                self.otherwise("the speed is that of the slip, without the stretch before it");
                let names = ["mu_slow", "mu_fast", "rate"];
                let values = [slow, fast, rate].map(Ron::from);
                std::iter::once(("friction_model", Ron::word("Velocity")))
                    .chain(names.into_iter().zip(values))
                    .collect()
            }
            _ => {
                self.lost("this friction model is not read");
                self.frictions.insert(tag, None);
                return Ok(());
            }
        };
        while let Some(more) = a.option() {
            self.unread(more);
        }
        self.frictions.insert(tag, Some(Friction { fields, coulomb }));
        Ok(())
    }
}

/// Points of both sides from those of one.
fn sided(all: &[f64]) -> Option<Vec<[f64; 2]>> {
    let up: Vec<[f64; 2]> = all.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
    let rising = up.first().is_some_and(|p| p[0] > 0.0) && up.windows(2).all(|w| w[0][0] < w[1][0]);
    if !rising || !all.len().is_multiple_of(2) {
        return None;
    }
    let down = up.iter().rev().map(|p| [-p[0], -p[1]]);
    Some(down.chain([[0.0, 0.0]]).chain(up.iter().copied()).collect())
}
