//! A reader of XML that accepts nothing but well-formed elements, attributes and text.

/// The start of an element.
#[derive(Debug)]
pub(crate) struct Element {
    pub(crate) name: String,
    attributes: Vec<(String, String)>,
}

impl Element {
    pub(crate) fn get(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|it| it.0 == name).map(|it| it.1.as_str())
    }

    pub(crate) fn number(&self, name: &str) -> i64 {
        let text = self.get(name).unwrap_or_else(|| panic!("{self:?} has no {name}"));
        text.parse().unwrap_or_else(|_| panic!("{name} of {self:?} is no integer"))
    }
}

/// All elements in the order of their start tags.
pub(crate) fn parse(text: &str) -> Result<Vec<Element>, String> {
    let mut elements: Vec<Element> = Vec::new();
    let mut open: Vec<String> = Vec::new();
    let mut rest = text.trim_end();
    loop {
        let (before, tag) = rest.split_once('<').ok_or("no tag")?;
        characters(before)?;
        let (tag, after) = tag.split_once('>').ok_or("a tag without an end")?;
        rest = after;
        if let Some(name) = tag.strip_prefix('/') {
            if open.pop().as_deref() != Some(name) {
                return Err(format!("</{name}> ends nothing"));
            }
        } else {
            let (tag, is_empty) = tag.strip_suffix('/').map_or((tag, false), |tag| (tag, true));
            let (name, attributes) = tag.split_once(' ').unwrap_or((tag, ""));
            let element =
                Element { name: name.to_owned(), attributes: parse_attributes(attributes)? };
            elements.push(element);
            if !is_empty {
                open.push(name.to_owned());
            }
        }
        if open.is_empty() {
            return if rest.is_empty() {
                Ok(elements)
            } else {
                Err(format!("{rest} after the end"))
            };
        }
    }
}

fn parse_attributes(mut rest: &str) -> Result<Vec<(String, String)>, String> {
    let mut attributes: Vec<(String, String)> = Vec::new();
    while !rest.trim_start().is_empty() {
        let (name, after) =
            rest.trim_start().split_once("=\"").ok_or_else(|| format!("{rest} is no attribute"))?;
        let (value, after) = after.split_once('"').ok_or("a value without an end")?;
        characters(value)?;
        if attributes.iter().any(|it| it.0 == name)
            || !name.chars().all(|c| c.is_ascii_alphabetic() || c == '-')
        {
            return Err(format!("attribute {name}"));
        }
        attributes.push((name.to_owned(), value.to_owned()));
        rest = after;
    }
    Ok(attributes)
}

/// Only characters of XML 1.0, and only entities that need no declaration.
fn characters(text: &str) -> Result<(), String> {
    let allowed =
        |c: char| matches!(c, '\t' | '\n' | '\r' | ' '..='\u{fffd}' | '\u{10000}'..) && c != '<';
    if let Some(bad) = text.chars().find(|&c| !allowed(c)) {
        return Err(format!("character {bad:?}"));
    }
    for entity in text.split('&').skip(1) {
        let name = entity.split_once(';').ok_or("an entity without an end")?.0;
        if !matches!(name, "amp" | "lt" | "gt" | "quot" | "#39" | "#9" | "#10" | "#13") {
            return Err(format!("entity {name}"));
        }
    }
    Ok(())
}
