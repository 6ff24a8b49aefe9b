//! Colours and letters of drawings.

/// The rules of a class of drawings that say its colours, in light and in dark, and its letters.
///
/// ```
/// const STYLE: &str = cotama_drawing::palette!(".mine");
/// assert!(STYLE.starts_with(".mine{--paper:#fff;--ink:"));
/// ```
#[macro_export]
macro_rules! palette {
    ($class:literal) => {
        concat!(
            $class,
            "{--paper:#fff;--ink:#1b1f24;--quiet:#57606a;--line:#4b5561;--fill:#eef3f9;",
            "--hot:#c2410c;--glow:#ffedd5;",
            "color-scheme:light dark;font-family:Helvetica,Arial,'Liberation Sans',system-ui,",
            "sans-serif}\n@media screen and (prefers-color-scheme:dark){",
            $class,
            "{--paper:#14181d;--ink:#e6eaef;--quiet:#a0abb7;--line:#8b96a3;--fill:#222b36;",
            "--hot:#fb923c;--glow:#4a2712}}\n"
        )
    };
}
