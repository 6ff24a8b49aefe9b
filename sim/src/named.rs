//! Values that stand in files by their names.

use crate::trace::supervised::Autonomy;
use cotama_models::severity::{Class, Severity};
use cotama_models::team::ErrorClass;
use cotama_models::team::scenario::Stage;
use serde::{Deserialize, Deserializer, Serializer, de::Error};

/// A value with a name, and a name for one value only.
pub(crate) trait Named: Copy + 'static {
    /// Word for such values, in messages.
    const WHAT: &'static str;
    /// Returns the name.
    fn name(self) -> &'static str;

    /// Returns the value of a name.
    fn named(name: &str) -> Option<Self>;
}

macro_rules! named {
    ($($type:ty: $what:literal;)*) => {
        $( impl Named for $type {
            const WHAT: &'static str = $what;

            fn name(self) -> &'static str {
                <$type>::name(self)
            }

            fn named(name: &str) -> Option<Self> {
                <$type>::ALL.iter().copied().find(|it| it.name() == name)
            }
        } )*
    };
}

named! {
    Class: "class of decisions";
    ErrorClass: "class of errors";
    Autonomy: "autonomy mode";
    Severity: "severity";
    Stage: "stage of a robot";
}

/// Writes a value as its name.
pub(crate) fn serialize<T: Named, S: Serializer>(value: &T, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(value.name())
}

/// Reads a value from its name.
pub(crate) fn deserialize<'d, T: Named, D: Deserializer<'d>>(from: D) -> Result<T, D::Error> {
    let name = std::borrow::Cow::<'d, str>::deserialize(from)?;
    T::named(&name).ok_or_else(|| D::Error::custom(format!("unknown {} `{name}`", T::WHAT)))
}
