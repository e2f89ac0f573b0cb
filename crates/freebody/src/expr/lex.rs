//! Words of an expression.

use super::{ExprError, Message, Operator};
use std::ops::Range;

/// The smallest pieces of an expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    Number(f64),
    Name(String),
    Operator(Operator),
    Not,
    Open,
    Close,
    Comma,
    End,
}

/// Signs, longest first.
const SIGNS: [(&str, Token); 16] = [
    ("**", Token::Operator(Operator::Power)),
    ("<=", Token::Operator(Operator::LessEqual)),
    (">=", Token::Operator(Operator::GreaterEqual)),
    ("==", Token::Operator(Operator::Equal)),
    ("!=", Token::Operator(Operator::NotEqual)),
    ("<", Token::Operator(Operator::Less)),
    (">", Token::Operator(Operator::Greater)),
    ("+", Token::Operator(Operator::Add)),
    ("-", Token::Operator(Operator::Subtract)),
    ("*", Token::Operator(Operator::Multiply)),
    ("/", Token::Operator(Operator::Divide)),
    ("^", Token::Operator(Operator::Power)),
    ("(", Token::Open),
    (")", Token::Close),
    (",", Token::Comma),
    ("\u{2212}", Token::Operator(Operator::Subtract)),
];

/// Signs of other notations, with ours.
const FOREIGN: [(&str, &str); 8] = [
    ("&&", "write `and`"),
    ("||", "write `or`"),
    ("!", "write `not`"),
    ("=", "to compare, write `==`; an expression gives no name to its value"),
    ("\u{d7}", "write `*`"),
    ("\u{b7}", "write `*`"),
    ("\u{b0}", "units belong to whole quantities; in an expression angles are in radians"),
    ("%", "to take a part in a hundred, divide by 100"),
];

/// The first token at or after `from`, and where it stands.
pub(super) fn token(text: &str, from: usize) -> Result<(Token, Range<usize>), ExprError> {
    let start = from + text[from..].len() - text[from..].trim_start().len();
    let rest = &text[start..];
    let (token, length) = match rest.chars().next() {
        None => (Token::End, 0),
        Some(c) if c.is_ascii_digit() || c == '.' => number(rest, start)?,
        Some(c) if is_head(c) || c == '\'' => name(rest, start)?,
        Some(_) => sign(rest, start)?,
    };
    Ok((token, start..start + length))
}

/// Whether a name can be written without quotes.
pub(super) fn is_plain(text: &str) -> bool {
    !text.contains('\'') && matches!(token(text, 0), Ok((Token::Name(name), _)) if name == text)
}

fn sign(rest: &str, start: usize) -> Result<(Token, usize), ExprError> {
    if let Some((sign, token)) = SIGNS.iter().find(|(sign, _)| rest.starts_with(sign)) {
        return Ok((token.clone(), sign.len()));
    }
    let known = FOREIGN.iter().find(|(sign, _)| rest.starts_with(sign));
    let first = &rest[..rest.chars().next().map_or(0, char::len_utf8)];
    let (sign, hint) = known.copied().unwrap_or((first, "names with unusual letters go in single quotes"));
    let what = format!("`{sign}` has no meaning in an expression");
    Err(Message::new(what, hint).at(&(start..start + sign.len())))
}

fn number(rest: &str, start: usize) -> Result<(Token, usize), ExprError> {
    let digits = |from: usize| rest[from..].bytes().take_while(u8::is_ascii_digit).count();
    let mut length = digits(0);
    if rest[length..].starts_with('.') {
        length += 1 + digits(length + 1);
    }
    let tail = &rest.as_bytes()[length..];
    if matches!(tail.first(), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(tail.get(1), Some(b'+' | b'-')));
        let exponent = digits(length + 1 + sign);
        length += if exponent > 0 { 1 + sign + exponent } else { 0 };
    }
    let complain = |what: String, hint: &str| Err(Message::new(what, hint).at(&(start..start + length)));
    match rest[..length].parse::<f64>() {
        Ok(value) if value.is_finite() => Ok((Token::Number(value), length)),
        Ok(_) => complain(format!("{} is too large a number", &rest[..length]), "the largest is 1.79e308"),
        Err(_) => complain("a point alone is no number".into(), "write digits before or after it"),
    }
}

fn is_head(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

/// A name: segments joined by points, each a word or a quotation, with indices in brackets.
fn name(rest: &str, start: usize) -> Result<(Token, usize), ExprError> {
    let mut name = String::new();
    let mut length = 0;
    loop {
        length += segment(&rest[length..], start + length, &mut name)?;
        while rest[length..].starts_with('[') {
            length += index(&rest[length..], start + length, &mut name)?;
        }
        let mut later = rest[length..].chars();
        match (later.next(), later.next()) {
            (Some('.'), Some(c)) if is_head(c) || c == '\'' => name.push('.'),
            _ => break,
        }
        length += 1;
    }
    let token = match &rest[..length] {
        "and" => Token::Operator(Operator::And),
        "or" => Token::Operator(Operator::Or),
        "not" => Token::Not,
        _ => Token::Name(name),
    };
    Ok((token, length))
}

fn segment(rest: &str, start: usize, name: &mut String) -> Result<usize, ExprError> {
    let Some(quoted) = rest.strip_prefix('\'') else {
        let length = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        name.push_str(&rest[..length]);
        return Ok(length);
    };
    match quoted.find('\'') {
        Some(0) => {
            Err(Message::new("a quoted name is empty", "write the name between the quotes").at(&(start..start + 2)))
        }
        Some(length) => {
            name.push_str(&quoted[..length]);
            Ok(length + 2)
        }
        None => {
            let place = start..start + rest.len();
            Err(Message::new("a quoted name has no end", "close it with a single quote").at(&place))
        }
    }
}

fn index(rest: &str, start: usize, name: &mut String) -> Result<usize, ExprError> {
    let inside = &rest[1..];
    let length = inside.find(|c: char| c.is_whitespace() || "[]'".contains(c)).unwrap_or(inside.len());
    if length == 0 || !inside[length..].starts_with(']') {
        let hint = "write it without spaces, as in `link[3]`";
        return Err(Message::new("an index has no closing bracket", hint).at(&(start..start + 1 + length)));
    }
    name.push_str(&rest[..length + 2]);
    Ok(length + 2)
}
