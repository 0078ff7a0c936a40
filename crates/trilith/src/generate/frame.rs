//! The base-isolated frame: its numbers and what follows from them.

use super::FrameError;

/// Largest frame that is made.
pub(super) const MOST_NODES: usize = 2_000_000;

/// Longest motion that is made: its file then has about a hundred megabytes.
pub(super) const MOST_STEPS: usize = 1_000_000;
/// Largest length (m) and largest mass, force and coefficient of a dashpot (SI) of a frame: products of those of one
/// frame are numbers.
const MOST_LENGTH: f64 = 1e9;
const MOST: f64 = 1e60;

/// A rectangular section, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Horizontal side of a beam; of a column along Y.
    pub width: f64,
    /// Vertical side of a beam; of a column along X.
    pub depth: f64,
}

/// A moment frame in space on sliding isolators, shaken both ways.
///
/// Columns stand on a grid of bays, every level has beams both ways, the lowest level lies on isolators:
/// a linear spring W/R both ways and 1/sag·W vertically, beside a bearing that yields at μW after `slip`, with
/// W the share of the weight by tributary area. Two linear dampers tie the base to the ground. Masses
/// are lumped without rotary inertia, damping is of Rayleigh's kind, the motion is synthetic
/// ([`synthetic`](super::synthetic)). SI throughout.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Bays along X and along Y.
    pub bays: [usize; 2],
    /// Storeys above the base level.
    pub storeys: usize,
    /// Elements that every member is cut into.
    pub cuts: usize,
    /// Width of a bay, m.
    pub bay: f64,
    /// Height of a storey, m.
    pub storey: f64,
    /// Young's modulus, N/m².
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density of the members, kg/m³.
    pub density: f64,
    /// Columns.
    pub column: Section,
    /// Beams above the base.
    pub beam: Section,
    /// Beams of the base level.
    pub base_beam: Section,
    /// Mass of a floor beside its members, kg/m².
    pub floor: f64,
    /// The same of the base level.
    pub base_floor: f64,
    /// Gravity that makes weights of masses, m/s².
    pub gravity: f64,
    /// Friction coefficient of the isolators.
    pub mu: f64,
    /// Radius of their pendulum spring W/R, m.
    pub radius: f64,
    /// Deformation at which they slip, m.
    pub slip: f64,
    /// Shortening under their weight, m.
    pub sag: f64,
    /// Each of the two dampers as share of the critical damping of the block on its pendulum springs.
    pub damper_ratio: f64,
    /// Damping ratio at two frequencies, Hz.
    pub damping: f64,
    /// These frequencies, Hz.
    pub frequencies: [f64; 2],
    /// Largest acceleration of the ground along X and Y, m/s².
    pub peak: [f64; 2],
    /// Step of the motion and of the analysis, s.
    pub dt: f64,
    /// Length of both, s.
    pub duration: f64,
    /// Vectors of FNA from the recursion of the ground motion alone; none: those that the program chooses.
    pub vectors: Option<usize>,
    /// Share of the largest link force by which links may be out of equilibrium; none: that of the program.
    pub link_tolerance: Option<f64>,
}

impl Default for Frame {
    /// Two bays by two, three storeys, members whole.
    fn default() -> Self {
        Self {
            bays: [2, 2],
            storeys: 3,
            cuts: 1,
            bay: 6.0,
            storey: 3.5,
            young: 30e9,
            poisson: 0.2,
            density: 2500.0,
            column: Section { width: 0.6, depth: 0.6 },
            beam: Section { width: 0.35, depth: 0.65 },
            base_beam: Section { width: 0.6, depth: 0.9 },
            floor: 900.0,
            base_floor: 1200.0,
            gravity: 9.81,
            mu: 0.06,
            radius: 2.5,
            slip: 1e-3,
            sag: 1e-3,
            damper_ratio: 0.05,
            damping: 0.02,
            frequencies: [0.3, 10.0],
            peak: [0.4 * 9.81, 0.3 * 9.81],
            dt: 0.005,
            duration: 20.0,
            vectors: None,
            link_tolerance: None,
        }
    }
}

impl Frame {
    /// Names of the [presets](Self::preset), by size.
    pub const PRESETS: [&'static str; 6] = ["P1e2", "P1e3", "P1e4s", "P1e4", "P5e4", "P1e5"];

    /// A frame of about so many degrees of freedom as the name says, for measurements: the same building
    /// in six sizes, with a basis of FNA that holds the peaks to 0.1 %, and links in equilibrium to a millionth,
    /// which changes the peaks by less than 1e-7.
    #[must_use]
    pub fn preset(name: &str) -> Option<Self> {
        let (bays, storeys, cuts, vectors) = match name {
            "P1e2" => ([1, 1], 3, 1, 24),
            "P1e3" => ([5, 4], 5, 1, 96),
            "P1e4s" => ([5, 4], 5, 4, 96),
            "P1e4" => ([12, 12], 9, 1, 200),
            "P5e4" => ([9, 8], 8, 4, 160),
            "P1e5" => ([12, 12], 9, 4, 200),
            _ => return None,
        };
        let (vectors, link_tolerance) = (Some(vectors), Some(1e-6));
        Some(Self { bays, storeys, cuts, vectors, link_tolerance, ..Self::default() })
    }

    /// Refuses what is no frame.
    ///
    /// # Errors
    /// [`FrameError`] with the first number that is wrong.
    pub fn check(&self) -> Result<(), FrameError> {
        let counts = [
            ("bays along X", self.bays[0]),
            ("bays along Y", self.bays[1]),
            ("storeys", self.storeys),
            ("cuts", self.cuts),
            ("vectors", self.vectors.unwrap_or(1)),
        ];
        if let Some((name, _)) = counts.iter().find(|(_, n)| *n == 0) {
            return Err(FrameError::None(name));
        }
        let size = |n: usize| n as f64 + 1.0;
        let joints = size(self.bays[0]) * size(self.bays[1]) * size(self.storeys);
        // At most three members start at a joint.
        let nodes = joints * (3.0 * self.cuts as f64 - 2.0);
        if nodes > MOST_NODES as f64 {
            return Err(FrameError::TooLarge(nodes));
        }
        let numbers = [
            ("bay", self.bay),
            ("storey", self.storey),
            ("young", self.young),
            ("poisson", self.poisson),
            ("density", self.density),
            ("column width", self.column.width),
            ("column depth", self.column.depth),
            ("beam width", self.beam.width),
            ("beam depth", self.beam.depth),
            ("base beam width", self.base_beam.width),
            ("base beam depth", self.base_beam.depth),
            ("floor", self.floor),
            ("base floor", self.base_floor),
            ("gravity", self.gravity),
            ("mu", self.mu),
            ("radius", self.radius),
            ("slip", self.slip),
            ("sag", self.sag),
            ("damper ratio", self.damper_ratio),
            ("damping", self.damping),
            ("first frequency", self.frequencies[0]),
            ("second frequency", self.frequencies[1]),
            ("peak along X", self.peak[0]),
            ("peak along Y", self.peak[1]),
            ("dt", self.dt),
            ("duration", self.duration),
            ("link tolerance", self.link_tolerance.unwrap_or(1.0)),
        ];
        if let Some((name, value)) = numbers.into_iter().find(|(_, x)| *x <= 0.0 || !x.is_finite())
        {
            return Err(FrameError::NotPositive { name, value });
        }
        self.check_motion()?;
        self.check_vectors()?;
        self.check_sizes()
    }

    /// Refuses motions of no step, and of more than a file can hold.
    fn check_motion(&self) -> Result<(), FrameError> {
        let steps = self.duration / self.dt;
        if steps > MOST_STEPS as f64 {
            return Err(FrameError::TooLong { steps });
        }
        if steps < 1.0 - 1e-9 {
            return Err(FrameError::NoStep { dt: self.dt, duration: self.duration });
        }
        Ok(())
    }

    fn check_vectors(&self) -> Result<(), FrameError> {
        let (nodes, directions) = (self.nodes(), 6 * self.nodes());
        match self.vectors {
            Some(vectors) if vectors > directions => {
                Err(FrameError::Vectors { vectors, nodes, directions })
            }
            _ => Ok(()),
        }
    }

    /// Refuses numbers that are absurd together, such as widths whose square overflows.
    fn check_sizes(&self) -> Result<(), FrameError> {
        let [x, y] = self.bays.map(|n| n as f64 * self.bay);
        let height = self.storeys as f64 * self.storey;
        let weights = [self.weight(0, 0), self.weight(1, 0), self.weight(1, 1)];
        let of = |s: &Section| s.width.max(s.depth);
        let side = of(&self.column).max(of(&self.beam)).max(of(&self.base_beam));
        let smallest = weights.into_iter().fold(f64::INFINITY, f64::min);
        let sizes = [
            ("the length along X", x, MOST_LENGTH, "m"),
            ("the length along Y", y, MOST_LENGTH, "m"),
            ("the height", height, MOST_LENGTH, "m"),
            ("the largest side of a section", side, MOST_LENGTH, "m"),
            ("Young's modulus", self.young, MOST, "N/m²"),
            ("the mass of the frame", self.mass(), MOST, "kg"),
            ("the weight on an isolator", smallest, MOST, "N"),
            ("the stiffness of a pendulum", self.weight(1, 1) / self.radius, MOST, "N/m"),
            ("the stiffness of a bearing", self.mu * self.weight(1, 1) / self.slip, MOST, "N/m"),
            ("the vertical stiffness of an isolator", self.weight(1, 1) / self.sag, MOST, "N/m"),
            ("the coefficient of a damper", self.damper(), MOST, "N·s/m"),
        ];
        // Not a number is outside as well.
        let wrong = |(_, x, most, _): &(&str, f64, f64, &str)| !(*x > 0.0 && *x <= *most);
        match sizes.into_iter().find(wrong) {
            Some((what, value, most, unit)) => {
                Err(FrameError::OutOfReach { what, value, most, unit })
            }
            None => Ok(()),
        }
    }

    /// Joints of columns and beams.
    #[must_use]
    pub fn joints(&self) -> usize {
        self.isolators() * (self.storeys + 1)
    }

    /// Columns and beams.
    #[must_use]
    pub fn members(&self) -> usize {
        let [x, y] = self.bays;
        let beams = x * (y + 1) + y * (x + 1);
        self.storeys * self.isolators() + (self.storeys + 1) * beams
    }

    /// Joints, and where members are cut.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.joints() + self.members() * (self.cuts - 1)
    }

    /// Beam elements.
    #[must_use]
    pub fn elements(&self) -> usize {
        self.members() * self.cuts
    }

    /// Isolators: one under every column.
    #[must_use]
    pub fn isolators(&self) -> usize {
        (self.bays[0] + 1) * (self.bays[1] + 1)
    }

    /// Floor area of the joint at these grid lines, m².
    pub(super) fn area(&self, i: usize, j: usize) -> f64 {
        let share = |i: usize, n: usize| if i == 0 || i == n { self.bay / 2.0 } else { self.bay };
        share(i, self.bays[0]) * share(j, self.bays[1])
    }

    /// Mass of everything, kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        let [x, y] = self.bays.map(|n| n as f64);
        let beams = (x * (y + 1.0) + y * (x + 1.0)) * self.bay;
        let columns = (x + 1.0) * (y + 1.0) * self.storey;
        let of = |s: &Section| self.density * s.width * s.depth;
        let level = self.floor * x * y * self.bay * self.bay
            + of(&self.column) * columns
            + of(&self.beam) * beams;
        let base = self.base_floor * x * y * self.bay * self.bay + of(&self.base_beam) * beams;
        base + self.storeys as f64 * level
    }

    /// Weight on the isolator at these grid lines, N.
    pub(super) fn weight(&self, i: usize, j: usize) -> f64 {
        let [x, y] = self.bays.map(|n| n as f64);
        self.mass() * self.gravity * self.area(i, j) / (x * y * self.bay * self.bay)
    }

    /// Coefficient of each of the two dampers, N·s/m.
    #[must_use]
    pub fn damper(&self) -> f64 {
        2.0 * self.damper_ratio * self.mass() * (self.gravity / self.radius).sqrt()
    }
}
