//! The description of a structure that both sides are made from: the text of a model and the oracle.
//!
//! Nothing of the program is used here; directions count 0 … 5 for Ux, Uy, Uz, Rx, Ry, Rz.

/// A vector in space.
pub type V3 = [f64; 3];

/// Names of the directions of a node.
pub const DOFS: [&str; 6] = ["Ux", "Uy", "Uz", "Rx", "Ry", "Rz"];
/// Names of the local axes of a link.
pub const AXES: [&str; 6] = ["U1", "U2", "U3", "R1", "R2", "R3"];

/// A structure, what moves it and how it is solved.
#[derive(Clone, Debug, Default)]
pub struct Spec {
    /// What it is made after.
    pub family: &'static str,
    /// Motion stays in XZ, said by `plane`.
    pub plane: bool,
    /// Positions, m.
    pub nodes: Vec<V3>,
    /// Directions that are held.
    pub fixed: Vec<[bool; 6]>,
    /// Elements, constraints and links.
    pub members: Vec<Member>,
    /// Damping of the structure.
    pub damping: Damping,
    /// A static case with gravity comes first.
    pub gravity: bool,
    /// Forces at nodes.
    pub forces: Vec<Force>,
    /// Acceleration of the ground: direction 0 … 2 and m/s² over time.
    pub base: Vec<(usize, Function)>,
    /// Supports that move: node, direction, m or rad over time.
    pub moved: Vec<(usize, usize, Function)>,
    /// Initial values: node, direction, displacement, velocity.
    pub initial: Vec<(usize, usize, f64, f64)>,
    /// s.
    pub duration: f64,
    /// Output step, s.
    pub dt: f64,
    /// Tolerance of the step control; none: the default.
    pub tolerance: Option<f64>,
    /// Basis of the reduced solvers.
    pub basis: Basis,
    /// What is compared.
    pub outputs: Vec<Output>,
}

impl Spec {
    /// Ends at this time, s, or with the last output step before it.
    pub fn end_at(&mut self, t: f64) {
        let steps = (t / self.dt).floor();
        if steps < 1.0 {
            self.dt = t;
        }
        self.duration = self.dt * steps.max(1.0);
    }
}

/// A member and the nodes it stands at.
#[derive(Clone, Debug)]
pub struct Member {
    /// One node: to the ground.
    pub nodes: Vec<usize>,
    /// Local axis 1, where it is not along the nodes (two) or upwards (one).
    pub axis1: Option<V3>,
    /// What it is.
    pub kind: Kind,
}

/// Kinds of members.
#[derive(Clone, Debug)]
pub enum Kind {
    /// Beam of Bernoulli, or of Timoshenko where there is a shear coefficient.
    Beam(Beam),
    /// Bar: E, A, density, consistent mass.
    Truss(f64, f64, f64, bool),
    /// Springs and dashpots along and about the local axes.
    Spring([f64; 6], [f64; 6]),
    /// Point mass and moments of inertia.
    Mass(f64, V3),
    /// Inertance and local axis.
    Inerter(f64, usize),
    /// The second node is part of the same body as the first.
    RigidLink,
    /// These directions of the second node are those of the first.
    EqualDof(Vec<usize>),
    /// The nodes are one body; the first leads.
    RigidBody,
    /// The nodes are one body in the plane square to Z; the first leads.
    Diaphragm,
    /// A link on one local axis, or on the axes of its law.
    Link(Law, usize),
}

/// Section and mass of a beam, all local axes.
#[derive(Clone, Copy, Debug)]
pub struct Beam {
    /// Young's modulus.
    pub young: f64,
    /// Shear modulus.
    pub shear: f64,
    /// Area.
    pub area: f64,
    /// Second moment about local 2.
    pub i2: f64,
    /// Second moment about local 3.
    pub i3: f64,
    /// Torsion constant.
    pub torsion: f64,
    /// Shear coefficient; 0: no shear deformation.
    pub kappa: f64,
    /// Density.
    pub density: f64,
    /// Consistent mass.
    pub consistent: bool,
}

/// Laws of links.
#[derive(Clone, Debug)]
pub enum Law {
    /// Stop: k, opening.
    Gap(f64, f64),
    /// Cable: k, slack.
    Hook(f64, f64),
    /// c, exponent.
    Dashpot(f64, f64),
    /// k, c, exponent.
    Maxwell(f64, f64, f64),
    /// k, c, c beyond relief, relief force.
    Bilinear(f64, f64, f64, f64),
    /// Points of the curve.
    Elastic(Vec<f64>, Vec<f64>),
    /// Points of the curve for positive deformation from (0, 0) on; the other side is its image.
    Plastic(Vec<f64>, Vec<f64>),
    /// k, f_y, ratio, exponent.
    Wen(f64, f64, f64, f64),
    /// Contact with friction on local 1, 2, 3.
    Contact(Contact),
    /// K and C over U1, U2.
    Linear([[f64; 2]; 2], [[f64; 2]; 2]),
    /// k, f_y, ratio; plastic in the plane of local 2, 3.
    Elastomeric(f64, f64, f64),
    /// Sliding bearing with a concave surface.
    Pendulum(Pendulum),
    /// Spring and dashpot in contact.
    Kelvin(Kelvin),
    /// Spring of a power and a dissipation in contact.
    Hertz(Hertz),
    /// Ring spring.
    Ring(Ring),
    /// Smooth hysteresis that wears.
    Degrading(Degrading),
    /// Stiffness beside Maxwell branches, their stiffnesses and relaxation times.
    Branches(f64, Vec<f64>, Vec<f64>),
    /// Bearing that slides pressed and pulled.
    Tension(Tension),
    /// Bearing with four concave surfaces.
    Triple(Triple),
    /// Bearing with smooth plastic shear.
    Shear(Shear),
    /// Rigid body on points, in finite rotation about Y.
    Rocking(Rocking),
}

/// Pounding with a spring and a dashpot.
#[derive(Clone, Copy, Debug)]
pub struct Kelvin {
    /// Contact stiffness.
    pub k: f64,
    /// Contact dashpot.
    pub c: f64,
    /// Clearance.
    pub opening: f64,
    /// The dashpot acts on approach alone.
    pub approach: bool,
    /// It may pull.
    pub pull: bool,
}

/// Pounding with a spring of a power.
#[derive(Clone, Copy, Debug)]
pub struct Hertz {
    /// Contact stiffness, N/mⁿ.
    pub k: f64,
    /// Exponent.
    pub n: f64,
    /// Damping.
    pub xi: f64,
    /// Mass that strikes; counts where the dissipation acts on approach alone.
    pub mass: f64,
    /// Clearance.
    pub opening: f64,
    /// The dissipation goes with the speed over that at first touch, at least this one; 0: it acts on approach alone.
    pub slowest: f64,
}

/// Ring spring.
#[derive(Clone, Copy, Debug)]
pub struct Ring {
    /// Stiffness before slip.
    pub k: f64,
    /// Stiffness in slip, loading.
    pub k1: f64,
    /// Stiffness in slip, unloading.
    pub k2: f64,
    /// Precompression.
    pub u0: f64,
    /// Deformation at which the rings are closed; may be infinite.
    pub us: f64,
}

/// Smooth hysteresis after Bouc, Wen and Baber.
#[derive(Clone, Copy, Debug)]
pub struct Degrading {
    /// Stiffness at rest.
    pub k: f64,
    /// Deformation that z counts in.
    pub dy: f64,
    /// Stiffness after yielding over k.
    pub alpha: f64,
    /// Sharpness.
    pub n: f64,
    /// Shape.
    pub beta: f64,
    /// Shape.
    pub gamma: f64,
    /// Stiffness of z at rest.
    pub a0: f64,
    /// Loss of stiffness and strength.
    pub delta_a: f64,
    /// Loss of strength.
    pub delta_nu: f64,
    /// Loss of stiffness.
    pub delta_eta: f64,
}

/// Bearing that slides pressed and pulled.
#[derive(Clone, Copy, Debug)]
pub struct Tension {
    /// Stiffness pressed and pulled.
    pub stiff: [f64; 2],
    /// Clearances on both sides.
    pub gaps: [f64; 2],
    /// Dashpot along the axis.
    pub c: f64,
    /// Stiffness before slip.
    pub ks: f64,
    /// Radius; 0: flat.
    pub radius: f64,
    /// Friction coefficients pressed and pulled: slow, fast, rate s/m.
    pub friction: [[f64; 3]; 2],
}

/// Bearing with four concave surfaces.
#[derive(Clone, Copy, Debug)]
pub struct Triple {
    /// Stiffness in compression.
    pub kn: f64,
    /// Stiffness before slip of each surface.
    pub ks: f64,
    /// Radii, less their heights.
    pub radii: [f64; 4],
    /// Ways to the rims; 0: none.
    pub capacities: [f64; 4],
    /// Stiffness of the rims.
    pub stop: f64,
    /// Friction coefficients: slow, fast, rate s/m.
    pub friction: [[f64; 3]; 4],
}

/// Bearing with smooth plastic shear along local 2 and 3.
#[derive(Clone, Copy, Debug)]
pub struct Shear {
    /// Axial stiffness; 0: none.
    pub axial: f64,
    /// Elastic stiffness beside.
    pub elastic: [f64; 2],
    /// Strength.
    pub strength: [f64; 2],
    /// Deformation that z counts in.
    pub yields: [f64; 2],
    /// It is a rubber bearing, with a lead core of this diameter that stays cold.
    pub lead: Option<f64>,
}

/// Sliding bearing with a concave surface: local 1 is its axis, it slides along 2 and 3.
#[derive(Clone, Copy, Debug)]
pub struct Pendulum {
    /// Stiffness in compression.
    pub kn: f64,
    /// Stiffness before slip.
    pub ks: f64,
    /// Radius of the surface.
    pub radius: f64,
    /// Friction coefficient at rest.
    pub slow: f64,
    /// Friction coefficient at speed.
    pub fast: f64,
    /// From slow to fast, s/m.
    pub rate: f64,
}

/// Contact with friction.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Contact stiffness.
    pub kn: f64,
    /// Clearance.
    pub opening: f64,
    /// Contact dashpot.
    pub c: f64,
    /// It may pull.
    pub pull: bool,
    /// Friction coefficient at rest; 0: no friction.
    pub slow: f64,
    /// Friction coefficient at speed.
    pub fast: f64,
    /// From slow to fast, s/m.
    pub rate: f64,
    /// Stiffness before slip.
    pub ks: f64,
}

/// A rigid body in XZ that stands on points, its node at the centre.
#[derive(Clone, Debug)]
pub struct Rocking {
    /// Points along X and Z from the centre.
    pub points: Vec<[f64; 2]>,
    /// What each point does where it meets the ground; the clearance is that of the lowest.
    pub contact: Contact,
}

/// Damping of the structure.
#[derive(Clone, Copy, Debug, Default)]
pub enum Damping {
    /// None.
    #[default]
    None,
    /// Ratio in all modes.
    Modal(f64),
    /// Factors of M and K.
    Rayleigh(f64, f64),
}

/// A force at a node over time.
#[derive(Clone, Debug)]
pub struct Force {
    /// Node.
    pub node: usize,
    /// Direction.
    pub dof: usize,
    /// N or N·m.
    pub value: f64,
    /// Multiple over time.
    pub function: Function,
}

/// A function of time.
#[derive(Clone, Debug)]
pub enum Function {
    /// amplitude, start.
    Step(f64, f64),
    /// amplitude, start, rise.
    Ramp(f64, f64, f64),
    /// amplitude, frequency, cycles.
    Sine(f64, f64, f64),
    /// amplitude, start, duration.
    HalfSine(f64, f64, f64),
    /// amplitude, frequency, centre.
    Ricker(f64, f64, f64),
    /// Straight lines through points; zero after the last.
    Points(Vec<(f64, f64)>),
}

/// Basis of the reduced solvers.
#[derive(Clone, Copy, Debug, Default)]
pub enum Basis {
    /// Ritz vectors, as many as the program chooses.
    #[default]
    Ritz,
    /// As many Ritz vectors.
    RitzOf(usize),
    /// As many eigenvectors.
    EigenOf(usize),
    /// All.
    Complete,
}

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Output {
    /// Of a node and direction.
    Displacement(usize, usize),
    /// Of a node and direction.
    Velocity(usize, usize),
    /// Force of a link along a local axis.
    LinkForce(usize, usize),
    /// Deformation of a link along a local axis.
    LinkDeformation(usize, usize),
    /// Displacement of the first node against that of the second, along a direction.
    Drift(usize, usize, usize),
    /// With that of the base: of a node and direction.
    Acceleration(usize, usize),
    /// Force of a linear member, its springs and dashpots, at one of its nodes along a direction.
    End(usize, usize, usize),
}

impl Law {
    /// Local axes of the law; `axis` counts for laws of one.
    #[must_use]
    pub fn axes(&self, axis: usize) -> Vec<usize> {
        match self {
            Self::Contact(c) if c.slow > 0.0 => vec![0, 1, 2],
            Self::Pendulum(_) | Self::Tension(_) | Self::Triple(_) => vec![0, 1, 2],
            Self::Shear(s) if s.axial > 0.0 => vec![0, 1, 2],
            Self::Shear(_) => vec![1, 2],
            // Along Z, along X, about Y.
            Self::Rocking(_) => vec![0, 1, 5],
            Self::Contact(_) => vec![0],
            Self::Linear(..) => vec![0, 1],
            Self::Elastomeric(..) => vec![1, 2],
            _ => vec![axis],
        }
    }
}
