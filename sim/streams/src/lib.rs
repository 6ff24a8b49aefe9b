//! Random numbers from one seed, through named streams.
//!
//! Every name has its own generator, so another consumer of random numbers never shifts the draws
//! of the others. Integers, and arithmetic that IEEE 754 fixes; the same on every platform.
//!
//! ```
//! use cotama_streams::Streams;
//! let streams = Streams::new(7);
//! let mut people = streams.stream("people");
//! let first = people.below(1000);
//! let _other = streams.stream("doors").below(1000);
//! assert_eq!(streams.stream("people").below(1000), first);
//! ```

#![cfg_attr(test, allow(clippy::pedantic, clippy::unwrap_used))]
#![allow(clippy::cast_precision_loss)] // 53 bits and less

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// The source of all random numbers of a run.
///
/// ```
/// use cotama_streams::Streams;
/// let streams = Streams::new(7);
/// let draw = |name| streams.stream(name).below(1_000);
/// assert_eq!(draw("event rain"), draw("event rain")); // a stream begins anew each time
/// assert_ne!(streams.stream("a").bits(), streams.stream("b").bits());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Streams {
    seed: u64,
}

impl Streams {
    /// All streams of a seed.
    pub const fn new(seed: u64) -> Self {
        Self { seed }
    }

    /// The stream of this name, from its beginning.
    ///
    /// PCG XSL RR 128/64 (O'Neill, HMC-CS-2014-0905). Its increment is the FNV-1a hash of the name;
    /// its state is mixed from seed and hash, as PCG streams that share a state are correlated.
    pub fn stream(&self, name: &str) -> Stream {
        let hash = fnv1a(name.as_bytes());
        let mut mixer = self.seed ^ hash.rotate_left(32);
        let [a, b, c] = core::array::from_fn(|_| split_mix(&mut mixer));
        let state = u128::from(a) << 64 | u128::from(b);
        Stream { generator: Pcg64::new(state, u128::from(hash) << 64 | u128::from(c)) }
    }
}

/// The steps of a sum of four numbers below 2¹⁶ in deviations of it: √(3 / (2³² - 1)).
const PER_STEP: f64 = 2.642_899_792_130_302e-5;

/// A stream of random numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stream {
    generator: Pcg64,
}

impl Stream {
    /// The next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.generator.next_u64()
    }

    /// A number from 0 up to but without `bound`, all equally likely; 0 for bounds 0 and 1.
    ///
    /// Multiplication and rejection (Lemire, ACM TOMACS 29(1), 2019, algorithm 5).
    pub fn below(&mut self, bound: u64) -> u64 {
        if bound == 0 {
            return 0;
        }
        let mut product = u128::from(self.bits()) * u128::from(bound);
        if (product as u64) < bound {
            let threshold = bound.wrapping_neg() % bound;
            while (product as u64) < threshold {
                product = u128::from(self.bits()) * u128::from(bound);
            }
        }
        (product >> 64) as u64
    }

    /// A number from 0 up to but without 1, in steps of 2⁻⁵³, all equally likely.
    pub fn part(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// An error of mean 0 and deviation 1, at most 3.465 away.
    ///
    /// Irwin-Hall: the sum of the four quarters of the next 64 bits. It is nearly normal (its
    /// kurtosis is 2.7, where 3 is normal), and costs no function that machines compute otherwise.
    ///
    /// ```
    /// use cotama_streams::Streams;
    /// let mut noise = Streams::new(7).stream("noise");
    /// let errors: Vec<f64> = (0..10_000).map(|_| noise.error()).collect();
    /// let within = errors.iter().filter(|it| it.abs() < 1.0).count();
    /// assert!((6_600..6_900).contains(&within), "{within}");
    /// assert!(errors.iter().all(|it| it.abs() < 3.465));
    /// ```
    pub fn error(&mut self) -> f64 {
        let bits = self.bits();
        let quarter = |at: u32| (bits >> (16 * at) & 0xffff).cast_signed();
        let sum = quarter(0) + quarter(1) + quarter(2) + quarter(3);
        (sum - 2 * 0xffff) as f64 * PER_STEP
    }
}

/// The 64-bit FNV-1a hash of some bytes.
pub fn fnv1a(bytes: &[u8]) -> u64 {
    let step = |hash: u64, &byte: &u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}

/// One step of `SplitMix64` (Steele, Lea, Flood, OOPSLA 2014).
pub fn split_mix(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut mixed = *state;
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first(seed: u64, name: &str) -> [u64; 3] {
        let mut stream = Streams::new(seed).stream(name);
        std::array::from_fn(|_| stream.bits())
    }

    /// Exact values, found with a second program in another language: they must never change, or
    /// stored seeds no longer replay.
    #[test]
    fn the_numbers_of_a_seed_and_a_name_are_fixed() {
        assert_eq!(fnv1a(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(split_mix(&mut 0), 0xe220_a839_7b1d_cdaf);
        assert_eq!(
            first(0, ""),
            [8_438_595_295_397_450_058, 17_742_941_208_449_302_160, 17_898_652_684_700_603_018]
        );
        assert_eq!(
            first(1, "people"),
            [7_664_159_085_421_510_065, 10_433_203_562_392_936_983, 16_031_690_553_407_665_868]
        );
        let mut stream = Streams::new(1).stream("people");
        assert_eq!(std::array::from_fn::<_, 8, _>(|_| stream.below(10)), [4, 5, 8, 5, 8, 9, 2, 9]);
    }

    #[test]
    fn seeds_and_names_give_different_numbers() {
        assert_ne!(first(1, "people"), first(2, "people"));
        assert_ne!(first(1, "people"), first(1, "doors"));
    }

    #[test]
    fn small_draws_are_even_and_within_their_bound() {
        let mut stream = Streams::new(3).stream("dice");
        let mut counts = [0u32; 6];
        for _ in 0..60_000 {
            counts[stream.below(6) as usize] += 1;
        }
        assert!(counts.iter().all(|count| (9_600..10_400).contains(count)), "{counts:?}");
        assert_eq!(stream.below(0), 0);
        assert_eq!(stream.below(1), 0);
        let wide = (1 << 63) + 1;
        assert!((0..1000).all(|_| stream.below(wide) < wide));
    }

    /// Nearly half of all products are drawn again for a bound of 2^63 + 1.
    #[test]
    fn products_that_would_be_more_likely_are_drawn_again() {
        let bound = (1_u64 << 63) + 1;
        let threshold = (1_u64 << 63) - 1; // 2^64 modulo the bound
        let (mut stream, mut bits) =
            (Streams::new(3).stream("wide"), Streams::new(3).stream("wide"));
        let mut drawn = 0;
        for _ in 0..50 {
            let even = std::iter::repeat_with(|| u128::from(bits.bits()) * u128::from(bound));
            let product = even.inspect(|_| drawn += 1).find(|it| *it as u64 >= threshold).unwrap();
            assert_eq!(u128::from(stream.below(bound)), product >> 64);
        }
        assert!((80..120).contains(&drawn), "{drawn}");
    }
}
