//! Tokens to tree: a Pratt parser.
//!
//! Source: V. R. Pratt, Top down operator precedence, POPL 1973.

use std::ops::Range;

use super::lexer::{self, Spanned, Token, splice};
use super::tree::{Comparison, Id, Node, Operator, Tree};
use crate::error::{UnitError, UnitErrorKind};
use crate::error_words::{WANTED_CALL, WANTED_POWER};
use crate::number::Number;
use crate::types::Type;
use crate::unit::Unit;

/// Deepest nesting of brackets, signs and powers. Sums and products may be of any length.
const DEPTH_LIMIT: usize = 100;

/// Binding strengths.
const COMPARISON: u8 = 1;
const SUM: u8 = 2;
const PRODUCT: u8 = 3;
const SIGN: u8 = 4;
const POWER: u8 = 5;

pub(crate) fn parse(text: &str) -> Result<Tree, UnitError> {
    if text.trim().is_empty() {
        return Err(UnitError::new(UnitErrorKind::Empty, 0..text.len()));
    }
    let tokens = lexer::tokens(text)?;
    let mut parser = Parser { text, tokens, at: 0, depth: 0, tree: Tree::default() };
    parser.expression(0)?;
    if parser.peek().is_some() {
        let wanted = if parser.after_if() { WANTED_CALL } else { "an operator" };
        return Err(parser.unexpected(wanted));
    }
    Ok(parser.tree)
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<Spanned>,
    at: usize,
    depth: usize,
    tree: Tree,
}

type Parsed = Result<Id, UnitError>;

impl Parser<'_> {
    /// An operand and all operators after it that bind more strongly than `floor`.
    fn expression(&mut self, floor: u8) -> Parsed {
        self.depth += 1;
        if self.depth > DEPTH_LIMIT {
            let kind = UnitErrorKind::TooDeep { limit: DEPTH_LIMIT };
            return Err(UnitError::new(kind, self.here()));
        }
        let start = self.here().start;
        let mut left = self.operand()?;
        loop {
            let next = match self.peek() {
                Some(Token::Operator(operator)) => self.binary(*operator, left, start, floor)?,
                Some(Token::Comparison(comparison)) => {
                    self.comparison(*comparison, left, start, floor)?
                }
                _ => None,
            };
            let Some(next) = next else { break };
            left = next;
        }
        self.depth -= 1;
        Ok(left)
    }

    fn binary(
        &mut self,
        operator: Operator,
        left: Id,
        start: usize,
        floor: u8,
    ) -> Result<Option<Id>, UnitError> {
        // The right side of a power may begin with a sign and contain another power: 2^-1, 2^3^2.
        let (strength, right_floor) = match operator {
            Operator::Add | Operator::Subtract => (SUM, SUM),
            Operator::Multiply | Operator::Divide => (PRODUCT, PRODUCT),
            Operator::Power => (POWER, SIGN),
        };
        if strength <= floor {
            return Ok(None);
        }
        self.at += 1;
        let right = self.expression(right_floor)?;
        Ok(Some(self.finish(Node::Binary(operator, left, right), start)))
    }

    fn comparison(
        &mut self,
        comparison: Comparison,
        left: Id,
        start: usize,
        floor: u8,
    ) -> Result<Option<Id>, UnitError> {
        if COMPARISON <= floor {
            return Ok(None);
        }
        self.at += 1;
        let right = self.expression(COMPARISON)?;
        if matches!(self.peek(), Some(Token::Comparison(_))) {
            return Err(UnitError::new(UnitErrorKind::ChainedComparison, self.here()));
        }
        Ok(Some(self.finish(Node::Compare(comparison, left, right), start)))
    }

    fn operand(&mut self) -> Parsed {
        let start = self.here().start;
        match self.peek().cloned() {
            Some(Token::Number(number)) => {
                self.at += 1;
                Ok(self.number(number, start))
            }
            Some(Token::Name(name)) => self.name(name),
            Some(Token::Operator(sign @ (Operator::Subtract | Operator::Add))) => self.signed(sign),
            Some(Token::Open) => {
                self.at += 1;
                let inner = self.expression(0)?;
                self.close()?;
                Ok(inner)
            }
            Some(Token::Operator(Operator::Multiply)) if self.after_star() => {
                Err(self.unexpected(WANTED_POWER))
            }
            _ => Err(self.unexpected("a number, a name or `(`")),
        }
    }

    fn before(&self) -> Option<&Spanned> {
        self.at.checked_sub(1).and_then(|i| self.tokens.get(i))
    }

    /// `if t < 5 [s] then …`.
    fn after_if(&self) -> bool {
        matches!(self.before(), Some((Token::Name(name), _)) if name == "if")
    }

    /// `x**2`.
    fn after_star(&self) -> bool {
        let here = self.here().start;
        let before = self.before();
        matches!(before, Some((Token::Operator(Operator::Multiply), star)) if star.end == here)
    }

    /// A number, with the unit that may follow it.
    fn number(&mut self, number: Number, start: usize) -> Id {
        let node = match self.peek() {
            Some(Token::Unit(unit)) => {
                let node = Node::Literal { value: in_si(unit, number.value), ty: unit.ty };
                self.at += 1;
                node
            }
            _ => Node::Number { value: number.value, exact: number.exact(self.text) },
        };
        self.finish(node, start)
    }

    /// A sign directly before a number belongs to it: `-20 [degC]`. Before anything else it
    /// negates.
    fn signed(&mut self, sign: Operator) -> Parsed {
        let span = self.here();
        self.at += 1;
        if let Some((Token::Number(number), at)) = self.tokens.get(self.at).cloned()
            && at.start == span.end
        {
            self.refuse_power(&span, &at)?;
            self.at += 1;
            return Ok(self.number(with_sign(number, sign), span.start));
        }
        let operand = self.expression(SIGN)?;
        match sign {
            Operator::Subtract => Ok(self.finish(Node::Negate(operand), span.start)),
            _ => Ok(operand),
        }
    }

    /// `-2^2` and `-2 [K]^2` are refused.
    fn refuse_power(&self, sign: &Range<usize>, number: &Range<usize>) -> Result<(), UnitError> {
        let after_number = self.tokens.get(self.at + 1);
        let (last, next) = match after_number {
            Some((Token::Unit(_), unit)) => (unit.end, self.tokens.get(self.at + 2)),
            other => (number.end, other),
        };
        if !matches!(next, Some((Token::Operator(Operator::Power), _))) {
            return Ok(());
        }
        let literal = self.text.get(sign.start..last).unwrap_or_default();
        let raised = splice(self.text, &(sign.start..last), &format!("({literal})"));
        let kind = UnitErrorKind::AmbiguousSign { negated: self.negated(sign), raised };
        Err(UnitError::new(kind, sign.start..last))
    }

    /// With a space after the sign, it is an operator.
    fn negated(&self, sign: &Range<usize>) -> String {
        let symbol = self.text.get(sign.clone()).unwrap_or_default();
        splice(self.text, sign, &format!("{symbol} "))
    }

    fn name(&mut self, name: String) -> Parsed {
        let name_span = self.here();
        let start = name_span.start;
        self.at += 1;
        if !matches!(self.peek(), Some(Token::Open)) {
            return Ok(self.finish(Node::Name(name), start));
        }
        self.at += 1;
        let mut arguments = Vec::new();
        if !matches!(self.peek(), Some(Token::Close)) {
            arguments.push(self.expression(0)?);
            while matches!(self.peek(), Some(Token::Comma)) {
                self.at += 1;
                arguments.push(self.expression(0)?);
            }
        }
        self.close()?;
        Ok(self.finish(Node::Call { function: name, name_span, arguments }, start))
    }

    fn close(&mut self) -> Result<(), UnitError> {
        if !matches!(self.peek(), Some(Token::Close)) {
            return Err(self.unexpected("an operator or `)`"));
        }
        self.at += 1;
        Ok(())
    }

    /// Adds a node that reaches from `start` to the last token taken.
    fn finish(&mut self, node: Node, start: usize) -> Id {
        let end = self.before().map_or(start, |(_, span)| span.end);
        self.tree.push(node, start..end)
    }

    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at).map(|(token, _)| token)
    }

    fn here(&self) -> Range<usize> {
        let end = self.text.len();
        self.tokens.get(self.at).map_or(end..end, |(_, span)| span.clone())
    }

    fn unexpected(&self, wanted: &'static str) -> UnitError {
        let span = self.here();
        let found = match self.text.get(span.clone()) {
            Some(text) if !text.is_empty() => format!("`{text}`"),
            _ => "the end".to_owned(),
        };
        UnitError::new(UnitErrorKind::Syntax { wanted, found }, span)
    }
}

fn with_sign(number: Number, sign: Operator) -> Number {
    if sign == Operator::Add {
        return number;
    }
    Number { value: -number.value, span: number.span }
}

/// The lexer has refused temperatures below absolute zero; rounding may still put 0 K a little
/// below.
fn in_si(unit: &Unit, value: f64) -> f64 {
    let si = unit.to_si(value);
    if unit.ty == Type::ABSOLUTE_TEMPERATURE { si.max(0.0) } else { si }
}
