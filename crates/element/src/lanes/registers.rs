//! Registers of processors with AVX2 and FMA or with AVX-512, and their instructions.

use pulp::Simd;
use pulp::x86::{V3, V4};
use std::arch::x86_64::{__m256d, __m512d, __mmask8};

/// What registers hold, in the types of the processor itself and as fields. A law is one function of thousands of operations:
/// arrays and functions inside one another in each of them took the compiler an eighth longer, and sweeps 1 to 2 %.
pub trait Registers: Copy {
    /// Numbers side by side.
    type Numbers: Copy;
    /// What comparing them gives.
    type Answers: Copy;
    /// What stands for the instructions.
    type Token: Simd;

    /// On a machine that has the instructions.
    fn of(token: Self::Token) -> Self;

    /// The instructions.
    fn token(self) -> Self::Token;
}

/// Registers that the token itself stands for.
macro_rules! of_token {
    ($($token:ty: $numbers:ty, $answers:ty;)*) => {$(
        impl Registers for $token {
            type Numbers = $numbers;
            type Answers = $answers;
            type Token = Self;

            #[inline(always)]
            fn of(token: Self) -> Self {
                token
            }
            #[inline(always)]
            fn token(self) -> Self {
                self
            }
        }
    )*};
}
of_token! {
    V3: __m256d, __m256d;
    V4: __m512d, __mmask8;
}

/// Two registers of AVX2.
#[derive(Clone, Copy, Debug)]
pub struct Two(pub(super) V3);

/// What they hold, in one line of the cache.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Both(pub(super) __m256d, pub(super) __m256d);

impl Registers for Two {
    type Numbers = Both;
    type Answers = Both;
    type Token = V3;

    #[inline(always)]
    fn of(token: V3) -> Self {
        Self(token)
    }
    #[inline(always)]
    fn token(self) -> V3 {
        self.0
    }
}

/// `$by!(name token, numbers …)`: the instructions of a processor under the names of what they do. Macros, as each
/// function would be one more inside another in every operation of a law.
macro_rules! instructions {
    ($d:tt $by:ident: $($name:ident $set:ident.$call:ident $([$how:ident])?,)* $({$($own:tt)*})*) => {
        macro_rules! $by {
            $(($name $d token:expr $d(, $d x:expr)*) => {
                $d token.$set.$call$(::<{ std::arch::x86_64::$how }>)?($d($d x),*)
            };)*
            $($($own)*)*
        }
        pub(super) use $by;
    };
}
instructions! {$ avx2:
    splat avx._mm256_set1_pd,
    add avx._mm256_add_pd,
    sub avx._mm256_sub_pd,
    mul avx._mm256_mul_pd,
    div avx._mm256_div_pd,
    max avx._mm256_max_pd,
    min avx._mm256_min_pd,
    mul_add fma._mm256_fmadd_pd,
    sqrt avx._mm256_sqrt_pd,
    bits_and avx._mm256_and_pd,
    bits_xor avx._mm256_xor_pd,
    lt avx._mm256_cmp_pd [_CMP_LT_OQ],
    le avx._mm256_cmp_pd [_CMP_LE_OQ],
    bitand avx._mm256_and_pd,
    bitor avx._mm256_or_pd,
    {
        (select $token:expr, $mask:expr, $yes:expr, $no:expr) => {
            $token.avx._mm256_blendv_pd($no, $yes, $mask)
        };
        (not $token:expr, $x:expr) => {
            $token.avx._mm256_xor_pd($x, $token.avx._mm256_set1_pd(f64::from_bits(u64::MAX)))
        };
        (any $token:expr, $x:expr) => { $token.avx._mm256_movemask_pd($x) != 0 };
    }
}
instructions! {$ avx512:
    splat avx512f._mm512_set1_pd,
    add avx512f._mm512_add_pd,
    sub avx512f._mm512_sub_pd,
    mul avx512f._mm512_mul_pd,
    div avx512f._mm512_div_pd,
    max avx512f._mm512_max_pd,
    min avx512f._mm512_min_pd,
    mul_add avx512f._mm512_fmadd_pd,
    sqrt avx512f._mm512_sqrt_pd,
    bits_and avx512dq._mm512_and_pd,
    bits_xor avx512dq._mm512_xor_pd,
    lt avx512f._mm512_cmp_pd_mask [_CMP_LT_OQ],
    le avx512f._mm512_cmp_pd_mask [_CMP_LE_OQ],
    {
        (select $token:expr, $mask:expr, $yes:expr, $no:expr) => {
            $token.avx512f._mm512_mask_blend_pd($mask, $no, $yes)
        };
        (bitand $token:expr, $x:expr, $y:expr) => { $x & $y };
        (bitor $token:expr, $x:expr, $y:expr) => { $x | $y };
        (not $token:expr, $x:expr) => { !$x };
        (any $token:expr, $x:expr) => { $x != 0 };
    }
}

/// `in_one!(by name registers, …)`: an instruction for one register; [`in_two`] for two.
macro_rules! in_one {
    ($by:ident $name:ident $s:expr $(, $x:expr)*) => { $by!($name $s $(, $x)*) };
}
macro_rules! in_two {
    ($by:ident splat $s:expr, $x:expr) => {{
        let one = $by!(splat $s.0, $x);
        Both(one, one)
    }};
    ($by:ident any $s:expr, $x:expr) => { $by!(any $s.0, $by!(bitor $s.0, $x.0, $x.1)) };
    ($by:ident $name:ident $s:expr $(, $x:expr)*) => {
        Both($by!($name $s.0 $(, $x.0)*), $by!($name $s.0 $(, $x.1)*))
    };
}
pub(super) use {in_one, in_two};
