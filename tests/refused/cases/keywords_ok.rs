//! Names that are words of Rust.
cotama_core::net! {
    /// A loop.
    pub mod r#loop {
        places { r#type: 1, r#match }
        flags { r#async }
        events { r#move, Break }
        outputs { r#yield }
        transitions {
            r#fn on r#move [!r#async]: r#type => r#match do r#async = true emit r#yield;
            r#return on Break: r#match => r#type;
        }
        ignore { r#move in r#match; Break in r#type; }
        laws { reachable(r#match); never_both(r#type, r#match); }
    }
}
