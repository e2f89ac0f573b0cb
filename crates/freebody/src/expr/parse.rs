//! From text to syntax tree.

use super::lex::{token, Token};
use super::{Ast, ExprError, Kind, Message, Operator};
use std::ops::Range;

/// Most pieces in an expression.
pub const MAX_NODES: usize = 10_000;
/// Most parentheses, arguments, signs and powers inside one another.
pub const MAX_DEPTH: usize = 64;

/// Operators from the loosest to the tightest; power binds tighter still, and is read apart.
const LEVELS: [&[Operator]; 5] = [
    &[Operator::Or],
    &[Operator::And],
    &[
        Operator::Less,
        Operator::LessEqual,
        Operator::Greater,
        Operator::GreaterEqual,
        Operator::Equal,
        Operator::NotEqual,
    ],
    &[Operator::Add, Operator::Subtract],
    &[Operator::Multiply, Operator::Divide],
];
const COMPARISON: usize = 2;

/// The syntax tree of `text`.
///
/// ```
/// let tree = freebody::expr::parse("m1*g*sin('crank angle')").unwrap();
/// assert_eq!(tree.span, 0..23);
/// let error = freebody::expr::parse("2 m1").unwrap_err();
/// assert_eq!((error.at, error.hint.as_str()), (2..4, "a product needs `*`; units belong to whole quantities"));
/// ```
pub fn parse(text: &str) -> Result<Ast, ExprError> {
    let (next, at) = token(text, 0)?;
    let mut parser = Parser { text, next, at, end: 0, after_number: false, nodes: 0, depth: 0 };
    let ast = parser.chain(0)?;
    match parser.next {
        Token::End => Ok(ast),
        _ => Err(parser.unexpected("an operator or the end")),
    }
}

struct Parser<'a> {
    text: &'a str,
    /// The token ahead and where it stands.
    next: Token,
    at: Range<usize>,
    /// Where the token before it ended.
    end: usize,
    after_number: bool,
    nodes: usize,
    depth: usize,
}

impl Parser<'_> {
    fn advance(&mut self) -> Result<Token, ExprError> {
        self.end = self.at.end;
        self.after_number = matches!(self.next, Token::Number(_));
        let (next, at) = token(self.text, self.end)?;
        self.at = at;
        Ok(std::mem::replace(&mut self.next, next))
    }

    fn node(&mut self, kind: Kind, start: usize) -> Result<Ast, ExprError> {
        self.nodes += 1;
        let span = start..self.end;
        if self.nodes > MAX_NODES {
            let what = format!("the expression has more than {MAX_NODES} pieces");
            return Err(Message::new(what, "split it into named quantities, or use a table").at(&span));
        }
        Ok(Ast { kind, span })
    }

    /// Reads something that may hold itself, no deeper than the limit.
    fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> Result<T, ExprError>) -> Result<T, ExprError> {
        if self.depth == MAX_DEPTH {
            let what = format!("the expression is nested more than {MAX_DEPTH} deep");
            return Err(Message::new(what, "name its inner quantities").at(&self.at));
        }
        self.depth += 1;
        let result = read(self);
        self.depth -= 1;
        result
    }

    fn chain(&mut self, level: usize) -> Result<Ast, ExprError> {
        if level == LEVELS.len() {
            return self.signed();
        }
        let start = self.at.start;
        if level == COMPARISON && self.next == Token::Not {
            self.advance()?;
            let inner = self.nested(|p| p.chain(COMPARISON))?;
            return self.node(Kind::Not(Box::new(inner)), start);
        }
        let first = self.chain(level + 1)?;
        let mut rest = Vec::new();
        while let Token::Operator(operator) = self.next {
            if !LEVELS[level].contains(&operator) {
                break;
            }
            if level == COMPARISON && !rest.is_empty() {
                return Err(Message::new("comparisons do not chain", "write `a < b and b < c`").at(&self.at));
            }
            self.advance()?;
            rest.push((operator, self.chain(level + 1)?));
        }
        match rest.is_empty() {
            true => Ok(first),
            false => self.node(Kind::Chain(Box::new(first), rest), start),
        }
    }

    /// A power, with any signs before it.
    fn signed(&mut self) -> Result<Ast, ExprError> {
        let start = self.at.start;
        match self.next {
            Token::Operator(Operator::Add) => {
                self.advance()?;
                self.nested(Self::signed)
            }
            Token::Operator(Operator::Subtract) => {
                self.advance()?;
                let inner = self.nested(Self::signed)?;
                self.node(Kind::Negate(Box::new(inner)), start)
            }
            _ => self.power(),
        }
    }

    fn power(&mut self) -> Result<Ast, ExprError> {
        let start = self.at.start;
        let base = self.operand()?;
        if self.next != Token::Operator(Operator::Power) {
            return Ok(base);
        }
        self.advance()?;
        // The exponent takes the signs and powers on its right: 2^-3^2 is 2^(-(3^2)).
        let exponent = self.nested(Self::signed)?;
        self.node(Kind::Chain(Box::new(base), vec![(Operator::Power, exponent)]), start)
    }

    fn operand(&mut self) -> Result<Ast, ExprError> {
        let start = self.at.start;
        match self.next {
            Token::Number(_) | Token::Name(_) | Token::Open => {}
            _ => return Err(self.missing_operand()),
        }
        match self.advance()? {
            Token::Number(value) => self.node(Kind::Number(value), start),
            Token::Name(name) if self.next == Token::Open => {
                self.advance()?;
                let arguments = self.nested(Self::arguments)?;
                self.node(Kind::Call(name, arguments), start)
            }
            Token::Name(name) => self.node(Kind::Name(name), start),
            _ => {
                let inner = self.nested(|p| p.chain(0))?;
                self.close("a closing parenthesis")?;
                Ok(inner)
            }
        }
    }

    /// Arguments and the parenthesis that closes them.
    fn arguments(&mut self) -> Result<Vec<Ast>, ExprError> {
        let mut arguments = Vec::new();
        if self.next == Token::Close {
            self.advance()?;
            return Ok(arguments);
        }
        loop {
            arguments.push(self.chain(0)?);
            if self.next != Token::Comma {
                break;
            }
            self.advance()?;
        }
        self.close("a comma or a closing parenthesis")?;
        Ok(arguments)
    }

    fn close(&mut self, wanted: &str) -> Result<(), ExprError> {
        match self.next {
            Token::Close => self.advance().map(drop),
            _ => Err(self.unexpected(wanted)),
        }
    }

    /// The complaint about what follows a complete operand.
    fn unexpected(&self, wanted: &str) -> ExprError {
        let hint = match (&self.next, self.after_number) {
            (Token::Name(_), true) => "a product needs `*`; units belong to whole quantities",
            (Token::Number(_) | Token::Name(_) | Token::Open, _) => "a product needs `*`",
            (Token::Close, _) => "drop it, or open one before it",
            (Token::End, _) => "close what is open",
            _ => "",
        };
        Message::new(format!("expected {wanted}, found {}", self.found()), hint).at(&self.at)
    }

    fn missing_operand(&self) -> ExprError {
        let hint = match self.next {
            Token::End if self.end == 0 => "the expression is empty",
            Token::Not => "put the condition that `not` belongs to in parentheses",
            _ => "something is missing here",
        };
        Message::new(format!("expected a number, a name or a parenthesis, found {}", self.found()), hint).at(&self.at)
    }

    fn found(&self) -> String {
        match self.next {
            Token::End => "the end".into(),
            _ => format!("`{}`", &self.text[self.at.clone()]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::spell;
    use super::*;

    #[test]
    fn names_may_be_dotted_indexed_and_quoted() {
        for (text, name) in [
            ("rod.A", "rod.A"),
            ("link[3].end", "link[3].end"),
            ("'crank speed'", "crank speed"),
            ("m1", "m1"),
            ("'my rod'.A", "my rod.A"),
            ("grid[i+1][2].µ", "grid[i+1][2].µ"),
            ("'and'", "and"),
        ] {
            let ast = parse(text).unwrap();
            assert_eq!((ast.kind, ast.span), (Kind::Name(name.into()), 0..text.len()));
            assert_eq!(parse(&spell(name)).unwrap().kind, Kind::Name(name.into()));
        }
    }

    #[test]
    fn the_tree_is_compact_as_data() {
        let tree = serde_json::to_string(&parse("f(x) - 2").unwrap()).unwrap();
        let call = r#"{"call":["f",[{"name":"x","span":[2,3]}]],"span":[0,4]}"#;
        assert_eq!(tree, format!(r#"{{"chain":[{call},[["-",{{"number":2.0,"span":[7,8]}}]]],"span":[0,8]}}"#));
    }

    #[test]
    fn errors_say_where_and_what_to_do() {
        for (text, at, what, hint) in [
            ("", 0..0, "found the end", "empty"),
            ("2kg", 1..3, "`kg`", "units belong to whole quantities"),
            ("1 + 2 m", 6..7, "`m`", "needs `*`"),
            ("(a + b", 6..6, "a closing parenthesis", "close"),
            ("sin(x", 5..5, "a comma or a closing", "close"),
            ("a + * b", 4..5, "`*`", "missing"),
            ("a) + b", 1..2, "`)`", "drop it"),
            ("a < b < c", 6..7, "do not chain", "and"),
            ("a && b", 2..4, "`&&`", "`and`"),
            ("a = b", 2..3, "`=`", "`==`"),
            ("'abc", 0..4, "no end", "quote"),
            ("link[3", 4..6, "bracket", "link[3]"),
            ("1e999", 0..5, "too large", ""),
        ] {
            let error = parse(text).unwrap_err();
            assert_eq!(error.at, at, "{text}: {error}");
            assert!(error.what.contains(what) && error.hint.contains(hint), "{text}: {error}");
        }
    }
}
