//! Scripts as trees, and their parser.

use super::value::Value;

/// Levels of brackets and operators within one script.
const MAX_LEVELS: usize = 100;
/// Bytes of a script.
const MAX_BYTES: usize = 1 << 16;

/// A sequence of statements; its value is that of the last one.
#[derive(Clone, Debug, PartialEq)]
pub struct Script {
    /// As it was written.
    pub text: String,
    /// At least one.
    pub statements: Vec<Expression>,
}

/// How an assignment changes an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assign {
    /// `:=`, which creates the entry.
    Create,
    /// `=`.
    Set,
    /// `+=`, `-=`, `*=`, `/=`: the operator.
    By(Binary),
}

/// An operator between two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Binary {
    Or,
    And,
    BitOr,
    BitXor,
    BitAnd,
    Add,
    Subtract,
    Join,
    Multiply,
    Divide,
}

/// A comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Comparison {
    Equal,
    Different,
    Less,
    Greater,
    AtMost,
    AtLeast,
}

/// A piece of a script that has a value.
#[derive(Clone, Debug, PartialEq)]
pub enum Expression {
    /// A number or a text.
    Literal(Value),
    /// An entry.
    Entry(String),
    /// `-a`.
    Minus(Box<Expression>),
    /// `~a`.
    Complement(Box<Expression>),
    /// `!a`.
    Not(Box<Expression>),
    /// `a + b` and the like.
    Binary(Binary, Box<Expression>, Box<Expression>),
    /// `a < b <= c`: the first operand, then pairs.
    Compare(Box<Expression>, Vec<(Comparison, Expression)>),
    /// `a ? b : c`.
    Choose(Box<[Expression; 3]>),
    /// An assignment to an entry.
    Assign(Assign, String, Box<Expression>),
}

/// Why a text is no script, and at which byte.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SyntaxError {
    /// Byte of the script.
    pub at: usize,
    /// The cause.
    pub message: String,
}

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Text(String),
    Number(Value),
    Name(String),
    Operator(&'static str),
    End,
}

/// Longer operators stand first.
const OPERATORS: [&str; 26] = [
    "..", "&&", "||", "==", "!=", "<=", ">=", ":=", "+=", "-=", "*=", "/=", "-", "+", "*", "/",
    "&", "|", "^", "~", "!", "<", ">", "=", "?", ":",
];

fn fail<T>(at: usize, message: impl Into<String>) -> Result<T, SyntaxError> {
    Err(SyntaxError { at, message: message.into() })
}

fn tokens(text: &str) -> Result<Vec<(usize, Token)>, SyntaxError> {
    let mut list = Vec::new();
    let mut at = 0;
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        let (token, length) = if first.is_whitespace() {
            at += first.len_utf8();
            continue;
        } else if first == '\'' {
            let Some(end) = rest[1..].find('\'') else {
                return fail(at, "a text without its closing quote");
            };
            (Token::Text(rest[1..=end].to_owned()), end + 2)
        } else if first.is_ascii_digit() {
            number(rest, at)?
        } else if first.is_ascii_alphabetic() || first == '_' || first == '@' {
            let more = |it: char| it.is_ascii_alphanumeric() || it == '_';
            let length = rest[1..].find(|it| !more(it)).map_or(rest.len(), |it| it + 1);
            (Token::Name(rest[..length].to_owned()), length)
        } else if let Some(it) = ["(", ")", ";"].iter().find(|it| rest.starts_with(**it)) {
            (Token::Operator(it), 1)
        } else if let Some(it) = OPERATORS.iter().find(|it| rest.starts_with(**it)) {
            (Token::Operator(it), it.len())
        } else {
            return fail(at, format!("`{first}` has no meaning here"));
        };
        list.push((at, token));
        at += length;
    }
    list.push((text.len(), Token::End));
    Ok(list)
}

fn number(rest: &str, at: usize) -> Result<(Token, usize), SyntaxError> {
    let digits = |from: usize| {
        let all = rest[from..].bytes().take_while(u8::is_ascii_digit).count();
        from + all
    };
    let (value, length) = if rest.starts_with("0x") || rest.starts_with("0X") {
        let end = 2 + rest[2..].bytes().take_while(u8::is_ascii_hexdigit).count();
        (i64::from_str_radix(&rest[2..end], 16).ok().map(Value::Integer), end)
    } else {
        let whole = digits(0);
        let mut end = whole;
        if rest[end..].starts_with('.') && digits(end + 1) > end + 1 {
            end = digits(end + 1);
        }
        if rest[end..].starts_with(['e', 'E']) {
            let signed = rest[end + 1..].starts_with(['+', '-']) as usize;
            if digits(end + 1 + signed) > end + 1 + signed {
                end = digits(end + 1 + signed);
            }
        }
        let integer = (end == whole).then(|| rest[..end].parse().ok().map(Value::Integer));
        (integer.unwrap_or_else(|| rest[..end].parse().ok().map(Value::Real)), end)
    };
    let more = rest[length..].chars().next().is_some_and(|it| it.is_alphabetic() || it == '_');
    match value {
        Some(value) if !more => Ok((Token::Number(value), length)),
        _ => fail(at, "this is no number; the names of entries begin with a letter"),
    }
}

struct Parser {
    tokens: Vec<(usize, Token)>,
    at: usize,
    levels: usize,
}

/// Reads a script: statements separated by `;`.
///
/// # Errors
///
/// Returns the first place at which the text is no script.
pub fn parse(text: &str) -> Result<Script, SyntaxError> {
    if text.len() > MAX_BYTES {
        return fail(0, format!("a script of more than {MAX_BYTES} bytes"));
    }
    let mut parser = Parser { tokens: tokens(text)?, at: 0, levels: 0 };
    let mut statements = Vec::new();
    while *parser.peek() != Token::End {
        statements.push(parser.expression(0)?);
        if *parser.peek() == Token::End {
            break;
        }
        if *parser.peek() != Token::Operator(";") {
            return fail(parser.place(), "expected an operator, or `;` before the next statement");
        }
        while *parser.peek() == Token::Operator(";") {
            parser.at += 1;
        }
    }
    if statements.is_empty() {
        return fail(text.len(), "an empty script");
    }
    Ok(Script { text: text.to_owned(), statements })
}

fn binary(operator: &str) -> Option<(u8, Binary)> {
    Some(match operator {
        "||" => (6, Binary::Or),
        "&&" => (8, Binary::And),
        "|" => (12, Binary::BitOr),
        "^" => (12, Binary::BitXor),
        "&" => (14, Binary::BitAnd),
        "+" => (16, Binary::Add),
        "-" => (16, Binary::Subtract),
        ".." => (16, Binary::Join),
        "*" => (18, Binary::Multiply),
        "/" => (18, Binary::Divide),
        _ => return None,
    })
}

fn comparison(token: &Token) -> Option<Comparison> {
    let Token::Operator(operator) = token else { return None };
    Some(match *operator {
        "==" => Comparison::Equal,
        "!=" => Comparison::Different,
        "<" => Comparison::Less,
        ">" => Comparison::Greater,
        "<=" => Comparison::AtMost,
        ">=" => Comparison::AtLeast,
        _ => return None,
    })
}

fn assignment(operator: &str) -> Option<Assign> {
    Some(match operator {
        ":=" => Assign::Create,
        "=" => Assign::Set,
        "+=" => Assign::By(Binary::Add),
        "-=" => Assign::By(Binary::Subtract),
        "*=" => Assign::By(Binary::Multiply),
        "/=" => Assign::By(Binary::Divide),
        _ => return None,
    })
}

impl Parser {
    fn peek(&self) -> &Token {
        &self.tokens[self.at].1
    }

    fn place(&self) -> usize {
        self.tokens[self.at].0
    }

    fn take(&mut self) -> Token {
        let token = self.tokens[self.at].1.clone();
        if token != Token::End {
            self.at += 1;
        }
        token
    }

    fn expect(&mut self, operator: &'static str) -> Result<(), SyntaxError> {
        let place = self.place();
        match self.take() {
            Token::Operator(it) if it == operator => Ok(()),
            _ => fail(place, format!("expected `{operator}`")),
        }
    }

    fn prefix(&mut self) -> Result<Expression, SyntaxError> {
        let place = self.place();
        Ok(match self.take() {
            Token::Operator("-") => Expression::Minus(Box::new(self.expression(20)?)),
            Token::Operator("~") => Expression::Complement(Box::new(self.expression(20)?)),
            Token::Operator("!") => Expression::Not(Box::new(self.expression(20)?)),
            Token::Operator("(") => {
                let inner = self.expression(0)?;
                self.expect(")")?;
                inner
            }
            Token::Number(value) => Expression::Literal(value),
            Token::Text(text) => Expression::Literal(Value::text(&text)),
            Token::Name(name) => match name.as_str() {
                "true" => Expression::Literal(Value::Real(1.0)),
                "false" => Expression::Literal(Value::Real(0.0)),
                _ => Expression::Entry(name),
            },
            Token::End => return fail(place, "a value is missing at the end"),
            Token::Operator(it) => return fail(place, format!("a value is missing before `{it}`")),
        })
    }

    fn expression(&mut self, least: u8) -> Result<Expression, SyntaxError> {
        self.levels += 1;
        if self.levels > MAX_LEVELS {
            return fail(self.place(), format!("more than {MAX_LEVELS} levels"));
        }
        let found = self.operators(least);
        self.levels -= 1;
        found
    }

    fn operators(&mut self, least: u8) -> Result<Expression, SyntaxError> {
        let begin = self.place();
        let mut left = self.prefix()?;
        loop {
            let Token::Operator(operator) = *self.peek() else { return Ok(left) };
            if let (Some(assign), true) = (assignment(operator), least <= 2) {
                let Expression::Entry(name) = left else {
                    return fail(begin, "only an entry can be assigned to");
                };
                self.at += 1;
                return Ok(Expression::Assign(assign, name, Box::new(self.expression(0)?)));
            }
            if operator == "?" && least <= 4 {
                self.at += 1;
                let yes = self.expression(0)?;
                self.expect(":")?;
                let no = self.expression(4)?;
                return Ok(Expression::Choose(Box::new([left, yes, no])));
            }
            if comparison(self.peek()).is_some() && least <= 10 {
                let mut pairs = Vec::new();
                while let Some(it) = comparison(self.peek()) {
                    self.at += 1;
                    pairs.push((it, self.expression(11)?));
                }
                left = Expression::Compare(Box::new(left), pairs);
                continue;
            }
            match binary(operator) {
                Some((binding, it)) if binding >= least => {
                    self.at += 1;
                    let right = self.expression(binding + 1)?;
                    left = Expression::Binary(it, Box::new(left), Box::new(right));
                }
                _ => return Ok(left),
            }
        }
    }
}
