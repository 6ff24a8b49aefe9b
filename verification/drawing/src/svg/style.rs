//! How drawings look.

/// The style sheet of drawings. Colours are said twice: first for programs that do not know custom
/// properties.
pub const STYLE: &str = concat!(
    crate::palette!(".cotama"),
    "\
.cotama .paper{fill:#fff;fill:var(--paper)}
.cotama text{fill:#1b1f24;fill:var(--ink);font-size:11px}
.cotama .name{font-size:13px}
.cotama .state .name,.cotama .strong{font-weight:600}
.cotama .middle{text-anchor:middle}
.cotama .end{text-anchor:end}
.cotama .quiet{fill:#57606a;fill:var(--quiet)}
.cotama .sources{fill:#57606a;fill:var(--quiet);font-style:italic}
.cotama .line{fill:none;stroke:#4b5561;stroke:var(--line);stroke-width:1.2}
.cotama .read .line{stroke-dasharray:4 3}
.cotama .head,.cotama .start{fill:#4b5561;fill:var(--line)}
.cotama .state rect{fill:#eef3f9;fill:var(--fill);stroke:#4b5561;stroke:var(--line);\
stroke-width:1.2}
.cotama .place circle.rim{fill:#fff;fill:var(--paper);stroke:#1b1f24;stroke:var(--ink);\
stroke-width:1.3}
.cotama .shared circle.rim{stroke-dasharray:4 3}
.cotama .token,.cotama .transition rect{fill:#1b1f24;fill:var(--ink)}
.cotama .hot .line{stroke:#c2410c;stroke:var(--hot);stroke-width:2}
.cotama .hot .head,.cotama .hot .token,.cotama .transition.hot rect,.cotama text.hot,\
.cotama text.hot tspan\
{fill:#c2410c;fill:var(--hot)}
.cotama .state.hot rect,.cotama .place.hot circle.rim\
{fill:#ffedd5;fill:var(--glow);stroke:#c2410c;stroke:var(--hot);stroke-width:2}
"
);
