//! Sets of named things, one bit each: modules, resources, flags, failure modes.

/// Declares the enum of the things and the set of them, `const` throughout, and checks that no two
/// share a name.
macro_rules! members {
    (
        $(#[$one:meta])* $item:ident,
        $(#[$many:meta])* $set:ident($bits:ty) {
            $($(#[doc = $doc:expr])+ $member:ident = $name:expr,)+
        }
    ) => {
        $(#[$one])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum $item { $($(#[doc = $doc])+ $member,)+ }

        impl $item {
            /// All of them, in the order of their declaration.
            pub const ALL: &'static [Self] = &[$(Self::$member),+];

            /// Returns the name in print.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$member => $name,)+ }
            }

            /// Returns the documentation.
            pub const fn doc(self) -> &'static str {
                match self { $(Self::$member => concat!($($doc),+).trim_ascii(),)+ }
            }

            /// The one of this name.
            pub fn named(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|it| it.name() == name)
            }
        }

        $(#[$many])*
        #[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $set($bits);

        impl $set {
            /// The empty set.
            pub const NONE: Self = Self(0);
            /// All there are.
            pub const ALL: Self = Self(<$bits>::MAX >> (<$bits>::BITS as usize - $item::ALL.len()));

            /// Makes the set of the list's items.
            #[must_use]
            pub const fn of(list: &[$item]) -> Self {
                let (mut set, mut at) = (Self::NONE, 0);
                while at < list.len() {
                    set = set.with(list[at]);
                    at += 1;
                }
                set
            }

            /// The set and one more.
            #[must_use]
            pub const fn with(self, one: $item) -> Self {
                Self(self.0 | 1 << one as u32)
            }

            /// The set less those of another.
            #[must_use]
            pub const fn without(self, other: Self) -> Self {
                Self(self.0 & !other.0)
            }

            /// Returns the union.
            #[must_use]
            pub const fn union(self, other: Self) -> Self {
                Self(self.0 | other.0)
            }

            /// Returns the intersection.
            #[must_use]
            pub const fn common(self, other: Self) -> Self {
                Self(self.0 & other.0)
            }

            /// Whether it holds this one.
            pub const fn has(self, one: $item) -> bool {
                self.0 & (1 << one as u32) != 0
            }

            /// Whether it holds all of another.
            pub const fn covers(self, other: Self) -> bool {
                other.0 & !self.0 == 0
            }

            /// Whether the two are the same set; `==` for constants.
            pub const fn is(self, other: Self) -> bool {
                self.0 == other.0
            }

            /// Whether it is empty.
            pub const fn is_empty(self) -> bool {
                self.0 == 0
            }

            /// How many it holds.
            pub const fn len(self) -> usize {
                self.0.count_ones() as usize
            }

            /// The first in the order of declaration.
            pub const fn first(self) -> Option<$item> {
                let at = self.0.trailing_zeros() as usize;
                if at < $item::ALL.len() { Some($item::ALL[at]) } else { None }
            }

            /// One bit a member, in the order of declaration.
            pub const fn bits(self) -> $bits {
                self.0
            }

            /// From bits; `None` when a bit stands for no member.
            pub const fn from_bits(bits: $bits) -> Option<Self> {
                if bits & !Self::ALL.0 == 0 { Some(Self(bits)) } else { None }
            }

            /// Iterates over the members in the order of declaration.
            pub fn iter(self) -> impl Iterator<Item = $item> {
                $item::ALL.iter().copied().filter(move |&one| self.has(one))
            }
        }

        /// The names, with blanks between; `-` for none.
        impl core::fmt::Display for $set {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                for (at, one) in self.iter().enumerate() {
                    write!(f, "{}{}", if at == 0 { "" } else { " " }, one.name())?;
                }
                if self.is_empty() { f.write_str("-") } else { Ok(()) }
            }
        }

        impl core::fmt::Debug for $set {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.debug_set().entries(self.iter()).finish()
            }
        }

        const _: () = assert!(
            $crate::cotama::members::differ(&[$($name),+]),
            concat!("two members of ", stringify!($item), " have the same name")
        );
    };
}
pub(crate) use members;

/// Whether no two names are the same.
pub(crate) const fn differ(names: &[&str]) -> bool {
    let mut one = 0;
    while one < names.len() {
        let mut other = one + 1;
        while other < names.len() {
            if same(names[one].as_bytes(), names[other].as_bytes()) {
                return false;
            }
            other += 1;
        }
        one += 1;
    }
    true
}

const fn same(a: &[u8], b: &[u8]) -> bool {
    if a.len() != b.len() {
        return false;
    }
    let mut at = 0;
    while at < a.len() {
        if a[at] != b[at] {
            return false;
        }
        at += 1;
    }
    true
}
