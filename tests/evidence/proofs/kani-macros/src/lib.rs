//! The attributes of Kani, for the stand-in crate `kani`.
use proc_macro::{TokenStream, TokenTree};

/// Keeps the harness, and puts a module of its name beside it with a constant `HARNESS`: its name,
/// its documentation, and whether it must fail.
#[proc_macro_attribute]
pub fn proof(_options: TokenStream, harness: TokenStream) -> TokenStream {
    let tokens: Vec<TokenTree> = harness.clone().into_iter().collect();
    let name =
        tokens.iter().position(|it| it.to_string() == "fn").and_then(|at| tokens.get(at + 1));
    let Some(TokenTree::Ident(name)) = name else {
        return "compile_error!(\"#[kani::proof] belongs on a function\");".parse().unwrap();
    };
    let (mut says, mut must_fail) = (String::new(), false);
    for token in &tokens {
        let TokenTree::Group(attribute) = token else { continue };
        let inner: Vec<TokenTree> = attribute.stream().into_iter().collect();
        must_fail |= inner.iter().any(|it| it.to_string() == "should_panic");
        if let [TokenTree::Ident(doc), _, TokenTree::Literal(line)] = &inner[..]
            && doc.to_string() == "doc"
        {
            says += &format!("{line}, \"\\n\", ");
        }
    }
    let beside = format!(
        "#[allow(missing_docs)] pub mod {name} {{ \
             pub const HARNESS: ::kani::Harness = ::kani::Harness {{ \
                 name: module_path!(), says: concat!({says}), \
                 run: super::{name}, must_fail: {must_fail} }}; }}"
    );
    harness.into_iter().chain(beside.parse::<TokenStream>().unwrap()).collect()
}

/// How often Kani unwinds loops, plus one; loops here end by themselves.
#[proc_macro_attribute]
pub fn unwind(_bound: TokenStream, harness: TokenStream) -> TokenStream {
    harness
}

/// The solver that Kani uses.
#[proc_macro_attribute]
pub fn solver(_name: TokenStream, harness: TokenStream) -> TokenStream {
    harness
}

/// The harness must fail; [`macro@proof`] has seen it.
#[proc_macro_attribute]
pub fn should_panic(_options: TokenStream, harness: TokenStream) -> TokenStream {
    harness
}
