//! A function of a set of losses, as cases that exclude one another.

/// Some losses that are there and some that are not; the others make no difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cube {
    /// The losses that are there.
    pub(super) lost: u32,
    /// The losses that are not there.
    pub(super) kept: u32,
}

/// Returns cases of the sets of losses that have `given`, out of `all`, and the value of the
/// function in each: they exclude one another and cover all such sets.
///
/// The case of a loss that makes no difference is not distinguished; the order of the losses is
/// that of their numbers, so that the same function gives the same cases.
pub(super) fn cubes<T: Copy + PartialEq>(
    all: u32,
    given: u32,
    of: &impl Fn(u32) -> T,
) -> Vec<(Cube, T)> {
    let mut found = Vec::new();
    split(all & !given, Cube { lost: given, kept: 0 }, of, &mut found);
    found.iter_mut().for_each(|it| it.0.lost &= !given);
    found
}

fn split<T: Copy + PartialEq>(
    free: u32,
    cube: Cube,
    of: &impl Fn(u32) -> T,
    found: &mut Vec<(Cube, T)>,
) {
    let first = of(cube.lost);
    let differs = |loss: &u32| {
        let rest = free & !loss;
        subsets(rest).any(|it| of(cube.lost | it) != of(cube.lost | it | loss))
    };
    match bits(free).find(differs) {
        None => found.push((cube, first)),
        Some(loss) => {
            // Losses before this one make no difference anywhere.
            let rest = free & !(loss | (loss - 1));
            split(rest, Cube { kept: cube.kept | loss, ..cube }, of, found);
            split(rest, Cube { lost: cube.lost | loss, ..cube }, of, found);
        }
    }
}

fn bits(set: u32) -> impl Iterator<Item = u32> {
    (0..32).map(|it| 1 << it).filter(move |it| set & it != 0)
}

/// All subsets of a set.
fn subsets(set: u32) -> impl Iterator<Item = u32> {
    let mut next = Some(0_u32);
    std::iter::from_fn(move || {
        let it = next?;
        next = (it != set).then(|| it.wrapping_sub(set) & set);
        Some(it)
    })
}

#[cfg(test)]
mod tests {
    use super::{cubes, subsets};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn cases_exclude_one_another_and_cover_every_set(
            all in 0_u32..64, given in 0_u32..64, table in prop::collection::vec(0_u8..3, 64),
        ) {
            let given = given & all;
            let of = |it: u32| table[it as usize & 63];
            let cases = cubes(all, given, &of);
            for set in subsets(all).filter(|it| it & given == given) {
                let here = |it: &&(super::Cube, u8)| {
                    set & it.0.lost == it.0.lost && set & it.0.kept == 0
                };
                let matching: Vec<_> = cases.iter().filter(here).collect();
                prop_assert_eq!(matching.len(), 1);
                prop_assert_eq!(matching[0].1, of(set));
            }
        }
    }
}
