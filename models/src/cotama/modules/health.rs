//! The module status vector: what is known to be broken, and what follows for each module.

use super::module::{Module, Modules};
use super::resources::Resources;
use super::table::available;

/// The diagnosed state of modules and resources.
///
/// ```
/// use cotama_models::cotama::{Health, Module, Resource, Resources};
/// let blind = Health { lost: Resources::of(&[Resource::Camera]), ..Health::SOUND };
/// assert!(!blind.available().has(Module::Cam));
/// assert!(blind.available().has(Module::Mcl));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Health {
    /// Modules that are faulty themselves.
    pub faulty: Modules,
    /// Resources that are lost.
    pub lost: Resources,
    /// Modules of which an ambiguous diagnosis says that they may be faulty.
    pub suspected: Modules,
}

/// The status of one module. Stated are available and unavailable; suspect is inferred, for an
/// ambiguous diagnosis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Status {
    /// The module can be used.
    Available,
    /// The module can be used, but would be unavailable if a suspected module were faulty.
    Suspect,
    /// The module cannot be used.
    Unavailable,
}

/// The status of every module (Durand et al., TAROS 2010, Section V.A: the module status vector).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct StatusVector {
    suspect: Modules,
    unavailable: Modules,
}

impl Health {
    /// Nothing is broken.
    pub const SOUND: Self =
        Self { faulty: Modules::NONE, lost: Resources::NONE, suspected: Modules::NONE };

    /// Returns the union of both.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self {
            faulty: self.faulty.union(other.faulty),
            lost: self.lost.union(other.lost),
            suspected: self.suspected.union(other.suspected),
        }
    }

    /// The modules that can be used, suspect ones among them.
    #[must_use]
    pub const fn available(self) -> Modules {
        available(self.faulty, self.lost)
    }

    /// The status of every module, closed under the needs of [`MODULES`](super::table::MODULES).
    ///
    /// ```
    /// use cotama_models::cotama::{Health, Module::{Nav, Smz, Ust}, Modules, Status};
    /// let ambiguous = Health { suspected: Modules::of(&[Ust]), ..Health::SOUND };
    /// let status = ambiguous.status_vector();
    /// assert_eq!(status.of(Smz), Status::Suspect);
    /// assert_eq!(status.of(Nav), Status::Available);
    /// ```
    pub const fn status_vector(self) -> StatusVector {
        let sure = self.available();
        StatusVector {
            suspect: sure.without(available(self.faulty.union(self.suspected), self.lost)),
            unavailable: Modules::ALL.without(sure),
        }
    }
}

impl StatusVector {
    /// The status of one module.
    pub const fn of(self, module: Module) -> Status {
        if self.unavailable.has(module) {
            Status::Unavailable
        } else if self.suspect.has(module) {
            Status::Suspect
        } else {
            Status::Available
        }
    }

    /// The modules that can be used, suspect ones among them.
    #[must_use]
    pub const fn available(self) -> Modules {
        Modules::ALL.without(self.unavailable)
    }

    /// Returns the available modules that are suspect.
    #[must_use]
    pub const fn suspect(self) -> Modules {
        self.suspect
    }
}
