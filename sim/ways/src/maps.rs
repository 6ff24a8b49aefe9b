//! The maps of the experiment.

/// Numbers of moving discs on the short and on the long way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Ratio {
    /// One on each.
    R11,
    /// One on the short way, three on the long one.
    R13,
    /// Three on the short way, one on the long one.
    R31,
    /// One on the short way, five on the long one.
    R15,
    /// Five on the short way, one on the long one.
    R51,
}

impl Ratio {
    /// All ratios, in the order in which the thesis names them.
    pub const ALL: [Self; 5] = [Self::R11, Self::R13, Self::R31, Self::R15, Self::R51];

    /// Discs on the short and on the long way.
    pub const fn discs(self) -> [usize; 2] {
        match self {
            Self::R11 => [1, 1],
            Self::R13 => [1, 3],
            Self::R31 => [3, 1],
            Self::R15 => [1, 5],
            Self::R51 => [5, 1],
        }
    }

    /// The name of its state in networks.
    pub const fn name(self) -> &'static str {
        match self {
            Self::R11 => "r1_1",
            Self::R13 => "r1_3",
            Self::R31 => "r3_1",
            Self::R15 => "r1_5",
            Self::R51 => "r5_1",
        }
    }
}

/// A map: the ring corridor, seen from elsewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Map {
    /// The discs.
    pub ratio: Ratio,
    /// Whether it is mirrored: `swapped` in appendix C of the thesis.
    pub is_mirrored: bool,
    /// Part of the ring by which start and goal are moved clockwise, in percent.
    pub shift_percent: u8,
    /// By how many quarters of a circle it is turned to the left.
    pub quarters: u8,
}

const fn map(ratio: Ratio, is_mirrored: bool, shift_percent: u8, quarters: u8) -> Map {
    Map { ratio, is_mirrored, shift_percent, quarters }
}

/// The 20 maps (Rohrmueller 2011, appendix C), each ratio four times.
pub const MAPS: [Map; 20] = [
    map(Ratio::R51, false, 0, 0),
    map(Ratio::R31, false, 0, 1),
    map(Ratio::R51, false, 0, 2),
    map(Ratio::R13, false, 0, 3),
    map(Ratio::R51, false, 20, 0),
    map(Ratio::R15, false, 20, 1),
    map(Ratio::R11, false, 20, 2),
    map(Ratio::R11, false, 20, 3),
    map(Ratio::R31, false, 40, 0),
    map(Ratio::R31, false, 40, 2),
    map(Ratio::R15, false, 40, 3),
    map(Ratio::R13, true, 0, 0),
    map(Ratio::R51, true, 0, 1),
    map(Ratio::R13, true, 0, 2),
    map(Ratio::R15, true, 0, 3),
    map(Ratio::R31, true, 20, 1),
    map(Ratio::R15, true, 20, 3),
    map(Ratio::R11, true, 40, 0),
    map(Ratio::R11, true, 40, 1),
    map(Ratio::R13, true, 40, 2),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_ratio_has_four_maps_and_no_map_stands_twice() {
        for ratio in Ratio::ALL {
            assert_eq!(MAPS.iter().filter(|it| it.ratio == ratio).count(), 4, "{ratio:?}");
        }
        let place = |it: &Map| (it.is_mirrored, it.shift_percent, it.quarters);
        let mut places: Vec<_> = MAPS.iter().map(place).collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), 20);
    }
}
