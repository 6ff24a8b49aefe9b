//! The reader of XMLBIF 0.3: the same networks as XML. In a table the variable's own state runs
//! fastest, and the first of its parents slowest.

use super::lexer::Lexer;
use super::read::{Block, Entry, File, Of};
use crate::data::{MAX_STATES, MAX_VARIABLES, Variable};
use crate::network::Network;
use crate::wrong::Wrong;

impl Network {
    /// Reads a network in XMLBIF 0.3, and notes as [`Network::from_bif`] has them. Elements that
    /// the format does not know, properties and attributes are passed over.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line and, of a name, the near one.
    pub fn from_xmlbif(text: &str) -> Result<(Self, Vec<String>), Wrong> {
        let lexer = Lexer::new(text);
        let parts = Scanner { lexer: &lexer, text, at: 0, open: Vec::new() }.parts()?;
        file(&parts, &lexer)?.network(&lexer)
    }
}

/// A text, the elements that it is in, and where it begins; without a text the end of an element.
struct Part {
    at: usize,
    within: String,
    text: Option<String>,
}

/// Elements may be nested so deep.
const MAX_DEPTH: usize = 16;

struct Scanner<'a> {
    lexer: &'a Lexer<'a>,
    text: &'a str,
    at: usize,
    open: Vec<&'a str>,
}

impl<'a> Scanner<'a> {
    fn parts(mut self) -> Result<Vec<Part>, Wrong> {
        let mut parts = Vec::new();
        while let Some(rest) = self.text.get(self.at..).filter(|it| !it.is_empty()) {
            let at = self.at;
            if !rest.starts_with('<') {
                let end = rest.find('<').unwrap_or(rest.len());
                self.at += end;
                if !rest[..end].trim().is_empty() {
                    let text = Some(self.unescaped(at, rest[..end].trim())?);
                    let at = at + rest.len() - rest.trim_start().len();
                    parts.push(Part { at, within: self.open.join("/"), text });
                }
            } else if rest.starts_with("<!--") {
                self.skip(rest, "-->")?;
            } else if rest.starts_with("<?") {
                self.skip(rest, "?>")?;
            } else if rest.starts_with("<!") {
                // A document type may have its declarations within.
                let plain = rest.find('>').unwrap_or(0);
                let inside = rest.find('[').is_some_and(|it| it < plain);
                self.skip(rest, if inside { "]>" } else { ">" })?;
            } else {
                self.tag(rest, &mut parts)?;
            }
        }
        match self.open.last() {
            None => Ok(parts),
            Some(name) => {
                let last = self.text.trim_end().len();
                let wrong = self.lexer.wrong(last, format!("the file ends inside <{name}>"));
                Err(wrong.help("is it whole?"))
            }
        }
    }

    fn skip(&mut self, rest: &str, end: &str) -> Result<(), Wrong> {
        let Some(at) = rest.find(end) else {
            return Err(self.lexer.wrong(self.at, "this does not end").help("is the file whole?"));
        };
        self.at += at + end.len();
        Ok(())
    }

    fn tag(&mut self, rest: &'a str, parts: &mut Vec<Part>) -> Result<(), Wrong> {
        let at = self.at;
        self.skip(rest, ">")?;
        let inside = &rest[1..self.at - at - 1];
        let name =
            |it: &'a str| it.split(|it: char| it.is_whitespace() || it == '/').next().unwrap_or("");
        if let Some(closed) = inside.strip_prefix('/') {
            let within = self.open.join("/");
            let open = self.open.pop();
            if open != Some(name(closed)) {
                let open = open.map_or_else(String::new, |it| format!(", and <{it}> is open"));
                let message = format!("</{}> ends nothing{open}", name(closed));
                return Err(self.lexer.wrong(at, message));
            }
            parts.push(Part { at, within, text: None });
        } else if !inside.ends_with('/') {
            if name(inside).is_empty() || self.open.len() == MAX_DEPTH {
                return Err(self.lexer.wrong(at, "no element may stand here"));
            }
            self.open.push(name(inside));
        }
        Ok(())
    }

    /// A text with the five entities of XML replaced.
    fn unescaped(&self, at: usize, text: &str) -> Result<String, Wrong> {
        let mut pieces = text.split('&');
        let mut whole = pieces.next().unwrap_or("").to_owned();
        for piece in pieces {
            let known = [("lt", '<'), ("gt", '>'), ("amp", '&'), ("quot", '"'), ("apos", '\'')];
            let found = piece.split_once(';').and_then(|(name, rest)| {
                known.iter().find(|it| it.0 == name).map(|it| (it.1, rest))
            });
            let Some((sign, rest)) = found else {
                return Err(self.lexer.wrong(at, "an entity that is none of XML's five"));
            };
            whole.push(sign);
            whole.push_str(rest);
        }
        Ok(whole)
    }
}

const NETWORK: &str = "BIF/NETWORK";

/// The blocks that elements make.
fn file<'t>(parts: &'t [Part], lexer: &Lexer<'t>) -> Result<File<'t>, Wrong> {
    let mut file = File::default();
    let (mut variable, mut states): (Option<(usize, &str)>, Vec<String>) = (None, Vec::new());
    let mut definition = Definition::default();
    let mut definitions = Vec::new();
    for part in parts {
        let Some(within) = part.within.strip_prefix(NETWORK) else { continue };
        let text = part.text.as_deref();
        match (within, text) {
            ("/NAME", Some(text)) => file.name = text,
            ("/VARIABLE/NAME", Some(text)) => variable = Some((part.at, text)),
            ("/VARIABLE/OUTCOME" | "/VARIABLE/VALUE", Some(text)) => {
                if states.iter().any(|it| it == text) {
                    return Err(lexer.wrong(part.at, format!("two states are called {text}")));
                }
                states.push(text.to_owned());
            }
            ("/VARIABLE", None) => {
                let Some((at, name)) = variable.take() else {
                    return Err(lexer.wrong(part.at, "this variable has no NAME"));
                };
                if !(1..=MAX_STATES).contains(&states.len()) {
                    let message =
                        format!("{name} has {} states, not 1 to {MAX_STATES}", states.len());
                    return Err(lexer.wrong(at, message));
                }
                let number = file.variables.len();
                if number == MAX_VARIABLES || file.numbers.insert(name, number).is_some() {
                    let message = format!("{name} is one variable too many, or there twice");
                    return Err(lexer.wrong(at, message));
                }
                let states = std::mem::take(&mut states);
                file.variables.push((at, Variable { name: name.to_owned(), states }));
            }
            ("/DEFINITION/FOR", Some(text)) => definition.child = Some((part.at, text)),
            ("/DEFINITION/GIVEN", Some(text)) => definition.parents.push((part.at, text)),
            ("/DEFINITION/TABLE", Some(text)) => {
                definition.at.get_or_insert(part.at);
                let words = text.split_whitespace();
                let place =
                    |word: &str| part.at + (word.as_ptr() as usize - text.as_ptr() as usize);
                definition.numbers.extend(words.map(|it| (place(it), it)));
            }
            ("/DEFINITION", None) => {
                definitions.push((part.at, std::mem::take(&mut definition)));
            }
            _ => {}
        }
    }
    for (end, Definition { child, parents, at, numbers }) in definitions {
        let Some((place, name)) = child else {
            return Err(lexer.wrong(end, "this definition has no FOR"));
        };
        let number = file.number(lexer, place, name)?;
        let at = at.unwrap_or(place);
        let entries = vec![Entry { at, of: Of::Rows, numbers }];
        if file.tables.insert(number, Block { at: place, parents, entries }).is_some() {
            return Err(lexer.wrong(place, format!("{name} has two definitions")));
        }
    }
    Ok(file)
}

#[derive(Default)]
struct Definition<'t> {
    child: Option<(usize, &'t str)>,
    parents: Vec<(usize, &'t str)>,
    at: Option<usize>,
    numbers: Vec<(usize, &'t str)>,
}
