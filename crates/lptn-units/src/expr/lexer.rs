//! Cuts an expression into tokens.

use std::ops::Range;

use super::tree::{Comparison, Operator};
use crate::error::{UnitError, UnitErrorKind};
use crate::error_words::{WANTED_CHOICE, WANTED_POWER};
use crate::kinship::above_absolute_zero;
use crate::number::{self, Number};
use crate::types::Type;
use crate::unit::Unit;
use crate::unit_parser::superscript;

#[derive(Clone, Debug)]
pub(crate) enum Token {
    Number(Number),
    /// The unit in brackets after a number.
    Unit(Unit),
    /// An identifier or path, without the spaces inside its brackets.
    Name(String),
    Operator(Operator),
    Comparison(Comparison),
    Open,
    Close,
    Comma,
}

pub(crate) type Spanned = (Token, Range<usize>);

pub(crate) fn tokens(text: &str) -> Result<Vec<Spanned>, UnitError> {
    let mut lexer = Lexer { text, at: 0, tokens: Vec::new() };
    lexer.skip_space();
    while lexer.at < text.len() {
        lexer.token()?;
        lexer.skip_space();
    }
    Ok(lexer.tokens)
}

struct Lexer<'a> {
    text: &'a str,
    at: usize,
    tokens: Vec<Spanned>,
}

/// Longest first.
static SYMBOLS: [(&str, Token); 20] = [
    ("<=", Token::Comparison(Comparison::LessEqual)),
    (">=", Token::Comparison(Comparison::GreaterEqual)),
    ("==", Token::Comparison(Comparison::Equal)),
    ("!=", Token::Comparison(Comparison::NotEqual)),
    ("≤", Token::Comparison(Comparison::LessEqual)),
    ("≥", Token::Comparison(Comparison::GreaterEqual)),
    ("<", Token::Comparison(Comparison::Less)),
    (">", Token::Comparison(Comparison::Greater)),
    ("+", Token::Operator(Operator::Add)),
    ("-", Token::Operator(Operator::Subtract)),
    ("\u{2212}", Token::Operator(Operator::Subtract)),
    ("*", Token::Operator(Operator::Multiply)),
    ("·", Token::Operator(Operator::Multiply)),
    ("⋅", Token::Operator(Operator::Multiply)),
    ("×", Token::Operator(Operator::Multiply)),
    ("/", Token::Operator(Operator::Divide)),
    ("^", Token::Operator(Operator::Power)),
    ("(", Token::Open),
    (")", Token::Close),
    (",", Token::Comma),
];

impl Lexer<'_> {
    fn token(&mut self) -> Result<(), UnitError> {
        let rest = self.rest();
        if let Some((symbol, token)) = SYMBOLS.iter().find(|(symbol, _)| rest.starts_with(symbol)) {
            let span = self.at..self.at + symbol.len();
            self.push(token.clone(), span);
            return Ok(());
        }
        if let Some(number) = number::scan(self.text, self.at, false)? {
            let span = number.span.clone();
            self.push(Token::Number(number), span);
            return Ok(());
        }
        match rest.chars().next() {
            Some('[') => self.unit(),
            Some(c) if is_identifier_start(c) => self.name(),
            _ => Err(self.unexpected()),
        }
    }

    fn push(&mut self, token: Token, span: Range<usize>) {
        self.at = span.end;
        self.tokens.push((token, span));
    }

    fn rest(&self) -> &str {
        self.text.get(self.at..).unwrap_or_default()
    }

    fn skip_space(&mut self) {
        self.at += self.rest().len() - self.rest().trim_start().len();
    }

    /// `[W/K]` directly after a number.
    fn unit(&mut self) -> Result<(), UnitError> {
        let Some(length) = self.rest().find(']') else { return Err(self.unclosed()) };
        let span = self.at..self.at + length + 1;
        if !matches!(self.tokens.last(), Some((Token::Number(_), _))) {
            return Err(self.misplaced(span));
        }
        let inner = span.start + 1..span.end - 1;
        let written = self.text.get(inner.clone()).unwrap_or_default();
        let complete = |fix: &str| splice(self.text, &inner, fix);
        let unit = Unit::parse(written).map_err(|e| e.shifted(inner.start).map_fix(complete))?;
        self.absolute_zero(&unit)?;
        self.push(Token::Unit(unit), span);
        Ok(())
    }

    fn unclosed(&self) -> UnitError {
        let kind = UnitErrorKind::Syntax { wanted: "`]`", found: "the end".to_owned() };
        UnitError::new(kind, self.at..self.text.len())
    }

    fn misplaced(&self, span: Range<usize>) -> UnitError {
        let follows =
            matches!(self.tokens.last(), Some((Token::Name(_) | Token::Unit(_) | Token::Close, _)));
        let in_name = self.text.get(..span.start).is_some_and(|t| t.ends_with(is_identifier_part));
        // a unit instead of a value means one of that unit: `[W]` as `1 [W]`
        let replacement = match self.text.get(span.clone()) {
            Some(unit) if !follows && !in_name => format!("1 {unit}"),
            _ => String::new(),
        };
        let fix = splice(self.text, &span, &replacement).trim().replace("  ", " ");
        UnitError::new(UnitErrorKind::MisplacedBracket { fix }, span)
    }

    /// Checks that the number before an absolute unit, with its sign, is a temperature above 0 K.
    fn absolute_zero(&self, unit: &Unit) -> Result<(), UnitError> {
        let [before @ .., (Token::Number(number), span)] = self.tokens.as_slice() else {
            return Ok(());
        };
        let negative = matches!(before.last(), Some((Token::Operator(Operator::Subtract), sign))
            if sign.end == span.start && starts_operand(before));
        let value = if negative { -number.value } else { number.value };
        match unit.ty == Type::ABSOLUTE_TEMPERATURE {
            true => above_absolute_zero(unit.to_si(value), span.clone()).map(|_| ()),
            false => Ok(()),
        }
    }

    /// `omega`, `steel.T`, `ring[1,2,3].T`, `planet[*].gear.T`.
    fn name(&mut self) -> Result<(), UnitError> {
        let start = self.at;
        let mut end = start + identifier_length(self.rest());
        loop {
            let rest = self.text.get(end..).unwrap_or_default();
            if rest.starts_with('[') {
                end += self.index_length(end, rest)?;
            } else if let Some(segment) =
                rest.strip_prefix('.').filter(|s| s.starts_with(is_identifier_start))
            {
                end += 1 + identifier_length(segment);
            } else {
                break;
            }
        }
        let name = self.text.get(start..end).unwrap_or_default().replace(char::is_whitespace, "");
        self.push(Token::Name(name), start..end);
        Ok(())
    }

    /// Length of `[1,2,*]` with its brackets.
    fn index_length(&self, at: usize, rest: &str) -> Result<usize, UnitError> {
        let Some(length) = rest.find(']') else {
            let kind = UnitErrorKind::Syntax { wanted: "`]`", found: "the end".to_owned() };
            return Err(UnitError::new(kind, at..self.text.len()));
        };
        let inner = rest.get(1..length).unwrap_or_default();
        let is_index = |c: char| c.is_ascii_digit() || matches!(c, ',' | '*' | ' ');
        if inner.trim().is_empty() || !inner.chars().all(is_index) {
            return Err(self.misplaced(at..at + length + 1));
        }
        Ok(length + 1)
    }

    fn unexpected(&self) -> UnitError {
        let c = self.rest().chars().next().unwrap_or(' ');
        let wanted = match c {
            '=' => "`==` for a comparison",
            '&' | '|' | '!' => "a comparison (conditions are combined by nesting `if`)",
            '?' => WANTED_CHOICE,
            _ if superscript(c).is_some() => WANTED_POWER,
            _ => "a number, a name, an operator or a bracket",
        };
        let kind = UnitErrorKind::Syntax { wanted, found: format!("`{c}`") };
        UnitError::new(kind, self.at..self.at + c.len_utf8())
    }
}

/// True if the last of these tokens, a sign, is at the start of an operand, not between two.
fn starts_operand(tokens: &[Spanned]) -> bool {
    let before = tokens.len().checked_sub(2).and_then(|i| tokens.get(i));
    !matches!(before, Some((Token::Number(_) | Token::Unit(_) | Token::Name(_) | Token::Close, _)))
}

/// `text` with this part replaced.
pub(crate) fn splice(text: &str, part: &Range<usize>, replacement: &str) -> String {
    let before = text.get(..part.start).unwrap_or_default();
    let after = text.get(part.end..).unwrap_or_default();
    format!("{before}{replacement}{after}").trim().to_owned()
}

fn is_identifier_start(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_'
}

fn is_identifier_part(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

fn identifier_length(text: &str) -> usize {
    text.find(|c: char| !is_identifier_part(c)).unwrap_or(text.len())
}
