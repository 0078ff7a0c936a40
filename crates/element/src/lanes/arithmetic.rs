//! How a sweep computes: which number it runs on, and with which instructions.

use super::law::{ErasedLaw, LaneLinks};
#[cfg(target_arch = "x86_64")]
use super::registers::{Registers, Two};
#[cfg(target_arch = "x86_64")]
use super::{Fused, Wide};
use super::{LaneContact, LaneStep, Real};
#[cfg(target_arch = "x86_64")]
use pulp::x86::{V3, V4};

/// Work to be done with the instructions of an arithmetic; `run` must be `#[inline(always)]`, and what
/// it calls as well.
pub trait Task<A: Arithmetic> {
    /// What it gives.
    type Output;
    /// Does it.
    fn run(self, with: A) -> Self::Output;
}

/// A kind of number and the instructions for it.
pub trait Arithmetic: Copy + Send + Sync {
    /// The number.
    type Real: Real;
    /// Number of lanes.
    const WIDTH: usize;
    /// True where hardly a machine computes with it: one size of compiled code is enough then.
    const IS_RARE: bool = false;

    /// Runs a task with all instructions that the machine has.
    fn run<T: Task<Self>>(self, task: T) -> T::Output;

    /// The same number in every lane.
    fn splat(self, x: f64) -> Self::Real;

    /// A number for each lane.
    fn gather(self, of: impl FnMut(usize) -> f64) -> Self::Real;

    /// The numbers of all lanes, side by side in memory.
    ///
    /// # Panics
    /// Where there are fewer than [`WIDTH`](Self::WIDTH).
    fn load(self, from: &[f64]) -> Self::Real;

    /// Puts the numbers of all lanes side by side.
    ///
    /// # Panics
    /// Where there are fewer places than [`WIDTH`](Self::WIDTH).
    fn store(self, x: Self::Real, to: &mut [f64]);

    /// The number of one lane.
    fn lane(self, x: Self::Real, lane: usize) -> f64;

    /// The first and the second numbers of [`WIDTH`](Self::WIDTH) pairs that lie one after the other, two numbers for
    /// each lane; lanes come in an order of their own, from which [`join_pairs`](Self::join_pairs) goes back.
    ///
    /// # Panics
    /// Where there are fewer.
    fn split_pairs(self, from: &[f64]) -> [Self::Real; 2];

    /// The pairs of all lanes, one after the other; behind them, where there are fewer than eight lanes, zeros.
    fn join_pairs(self, x: [Self::Real; 2]) -> [f64; 16];

    /// All of the answer of links of one law: forces, tangents, history and energies.
    fn respond(
        self,
        law: &ErasedLaw,
        links: &mut LaneLinks<'_, Self::Real>,
        out: &mut [LaneStep<Self::Real>],
    );

    /// What the contacts of links of one law do after a step, and which of them have overturned (1, else 0).
    fn contacts(
        self,
        law: &ErasedLaw,
        links: &LaneLinks<'_, Self::Real>,
        out: &mut [LaneContact<Self::Real>],
        fallen: &mut [Self::Real],
    );
}

/// One analysis at a time, on any machine.
#[derive(Clone, Copy, Debug)]
pub struct Portable;

impl Arithmetic for Portable {
    type Real = f64;
    const WIDTH: usize = 1;
    // Processors of this kind have had FMA since 2013.
    const IS_RARE: bool = cfg!(target_arch = "x86_64");

    // A call, as with vectors.
    #[inline(never)]
    fn run<T: Task<Self>>(self, task: T) -> T::Output {
        task.run(self)
    }
    #[inline(always)]
    fn splat(self, x: f64) -> f64 {
        x
    }
    #[inline(always)]
    fn gather(self, mut of: impl FnMut(usize) -> f64) -> f64 {
        of(0)
    }
    #[inline(always)]
    fn load(self, from: &[f64]) -> f64 {
        from[0]
    }
    #[inline(always)]
    fn store(self, x: f64, to: &mut [f64]) {
        to[0] = x;
    }
    #[inline(always)]
    fn lane(self, x: f64, _: usize) -> f64 {
        x
    }
    #[inline(always)]
    fn split_pairs(self, from: &[f64]) -> [f64; 2] {
        [from[0], from[1]]
    }
    #[inline(always)]
    fn join_pairs(self, [x, y]: [f64; 2]) -> [f64; 16] {
        let mut pairs = [0.0; 16];
        (pairs[0], pairs[1]) = (x, y);
        pairs
    }
    #[inline(always)]
    fn respond(self, law: &ErasedLaw, links: &mut LaneLinks<'_, f64>, out: &mut [LaneStep<f64>]) {
        (law.portable.respond)(self, links, out);
    }
    #[inline(always)]
    fn contacts(
        self,
        law: &ErasedLaw,
        links: &LaneLinks<'_, f64>,
        out: &mut [LaneContact<f64>],
        fallen: &mut [f64],
    ) {
        (law.portable.contacts)(self, links, out, fallen);
    }
}

/// One analysis at a time with FMA: equal to a lane of [`Avx2Lanes`] and [`Avx512Lanes`] to the bit.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug)]
pub struct FusedOne(pub(super) V3);

#[cfg(target_arch = "x86_64")]
struct Within<A, T>(A, T);

#[cfg(target_arch = "x86_64")]
impl<A: Arithmetic, T: Task<A>> pulp::WithSimd for Within<A, T> {
    type Output = T::Output;
    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> T::Output {
        self.1.run(self.0)
    }
}

#[cfg(target_arch = "x86_64")]
impl FusedOne {
    /// Where the machine has AVX2 and FMA.
    #[must_use]
    pub fn available() -> Option<Self> {
        V3::try_new().map(Self)
    }
}

#[cfg(target_arch = "x86_64")]
impl Arithmetic for FusedOne {
    type Real = Fused;
    const WIDTH: usize = 1;

    #[inline(always)]
    fn run<T: Task<Self>>(self, task: T) -> T::Output {
        pulp::Simd::vectorize(self.0, Within(self, task))
    }
    #[inline(always)]
    fn splat(self, x: f64) -> Fused {
        Fused(x)
    }
    #[inline(always)]
    fn gather(self, mut of: impl FnMut(usize) -> f64) -> Fused {
        Fused(of(0))
    }
    #[inline(always)]
    fn load(self, from: &[f64]) -> Fused {
        Fused(from[0])
    }
    #[inline(always)]
    fn store(self, x: Fused, to: &mut [f64]) {
        to[0] = x.0;
    }
    #[inline(always)]
    fn lane(self, x: Fused, _: usize) -> f64 {
        x.0
    }
    #[inline(always)]
    fn split_pairs(self, from: &[f64]) -> [Fused; 2] {
        [Fused(from[0]), Fused(from[1])]
    }
    #[inline(always)]
    fn join_pairs(self, [x, y]: [Fused; 2]) -> [f64; 16] {
        Portable.join_pairs([x.0, y.0])
    }
    #[inline(always)]
    fn respond(
        self,
        law: &ErasedLaw,
        links: &mut LaneLinks<'_, Fused>,
        out: &mut [LaneStep<Fused>],
    ) {
        (law.fused.respond)(self, links, out);
    }
    #[inline(always)]
    fn contacts(
        self,
        law: &ErasedLaw,
        links: &LaneLinks<'_, Fused>,
        out: &mut [LaneContact<Fused>],
        fallen: &mut [Fused],
    ) {
        (law.fused.contacts)(self, links, out, fallen);
    }
}

/// Eight analyses at a time, in the registers that a token of [`pulp`] stands for.
#[cfg(target_arch = "x86_64")]
macro_rules! eight_lanes {
    ($(#[$doc:meta])* $name:ident, $set:ident, $token:ident, $entries:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name($set);

        impl $name {
            /// Where the machine has them.
            #[must_use]
            pub fn available() -> Option<Self> {
                $token::try_new().map($set::of).map(Self)
            }
        }

        impl Arithmetic for $name {
            type Real = Wide<$set>;
            const WIDTH: usize = 8;

            #[inline(always)]
            fn run<T: Task<Self>>(self, task: T) -> T::Output {
                pulp::Simd::vectorize(self.0.token(), Within(self, task))
            }
            #[inline(always)]
            fn splat(self, x: f64) -> Self::Real {
                Self::Real::splat(self.0, x)
            }
            #[inline(always)]
            fn gather(self, of: impl FnMut(usize) -> f64) -> Self::Real {
                Self::Real::of_array(self.0, std::array::from_fn(of))
            }
            #[inline(always)]
            fn load(self, from: &[f64]) -> Self::Real {
                let [a, b, c, d, e, f, g, h] = from[..8] else { unreachable!("eight numbers") };
                Self::Real::of_array(self.0, [a, b, c, d, e, f, g, h])
            }
            #[inline(always)]
            fn store(self, x: Self::Real, to: &mut [f64]) {
                to[..8].copy_from_slice(&x.array());
            }
            #[inline(always)]
            fn lane(self, x: Self::Real, lane: usize) -> f64 {
                x.array()[lane]
            }
            #[inline(always)]
            fn split_pairs(self, from: &[f64]) -> [Self::Real; 2] {
                let pairs = from.first_chunk().expect("eight pairs");
                Self::Real::split_pairs(self.0, pairs)
            }
            #[inline(always)]
            fn join_pairs(self, x: [Self::Real; 2]) -> [f64; 16] {
                Self::Real::join_pairs(x)
            }
            #[inline(always)]
            fn respond(
                self,
                law: &ErasedLaw,
                links: &mut LaneLinks<'_, Self::Real>,
                out: &mut [LaneStep<Self::Real>],
            ) {
                (law.$entries.respond)(self, links, out);
            }
            #[inline(always)]
            fn contacts(
                self,
                law: &ErasedLaw,
                links: &LaneLinks<'_, Self::Real>,
                out: &mut [LaneContact<Self::Real>],
                fallen: &mut [Self::Real],
            ) {
                (law.$entries.contacts)(self, links, out, fallen);
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
eight_lanes! {
    /// Eight analyses at a time with AVX2 and FMA.
    Avx2Lanes, Two, V3, avx2
}
#[cfg(target_arch = "x86_64")]
eight_lanes! {
    /// Eight analyses at a time with AVX-512 (F, BW, CD, DQ and VL), with the bits of [`Avx2Lanes`].
    Avx512Lanes, V4, V4, avx512
}
