//! The names that a net and a player write to defmt's logs: feature `defmt`.
//!
//! Names are interned: they stand in the file of the image and not in flash, and numbers go over
//! the wire. What `net!` and `system!` make implements `defmt::Format` without a dependency on
//! defmt in the crate of the net.

/// Names of the enums of a net: `defmt::Format` writes that of the variant, and leaves out what an
/// event carries along.
#[cfg(feature = "defmt")]
#[doc(hidden)]
#[macro_export]
macro_rules! __logged_names {
    ($( $type:ident { $( $name:ident )* } )*) => { $(
        const _: () = {
            use $crate::__private::defmt;

            #[allow(non_camel_case_types, dead_code)]
            #[derive(defmt::Format)]
            enum Name { $( $name, )* }

            impl defmt::Format for $type {
                #[allow(unreachable_code, unused_variables)]
                fn format(&self, f: defmt::Formatter<'_>) {
                    let name: Name = match *self { $( Self::$name { .. } => Name::$name, )* };
                    defmt::write!(f, "{}", name);
                }
            }
        };
    )* };
}

/// Without the feature there is nothing to implement.
#[cfg(not(feature = "defmt"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __logged_names {
    ($( $type:ident { $( $name:ident )* } )*) => {};
}

/// Names of the enums of a system: the net, and what its own enum says.
#[cfg(feature = "defmt")]
#[doc(hidden)]
#[macro_export]
macro_rules! __logged_parts {
    ($( $type:ident )* => $nets:tt) => {
        $( $crate::__logged_parts! { @one $type $nets } )*
    };
    (@one $type:ident { $( $net:ident )* }) => {
        const _: () = {
            use $crate::__private::defmt;

            #[allow(non_camel_case_types)]
            #[derive(defmt::Format)]
            enum Name { $( $net(<parts::$net as Part>::$type), )* }

            impl defmt::Format for $type {
                fn format(&self, f: defmt::Formatter<'_>) {
                    let name = match *self { $( Self::$net(it) => Name::$net(it), )* };
                    defmt::write!(f, "{}", name);
                }
            }
        };
    };
}

/// Without the feature there is nothing to implement.
#[cfg(not(feature = "defmt"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __logged_parts {
    ($( $type:ident )* => $nets:tt) => {};
}

/// `lose at 500 ms: motors_off`.
#[cfg(feature = "defmt")]
impl<P, M> defmt::Format for crate::player::Firing<'_, P, M>
where
    P: crate::player::Names<Transition: defmt::Format, Output: defmt::Format>,
{
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "{} at {}", self.transition(), self.at);
        let mut between = defmt::intern!(": ");
        for output in self.outputs() {
            defmt::write!(f, "{=istr}{}", between, output);
            between = defmt::intern!(", ");
        }
    }
}
