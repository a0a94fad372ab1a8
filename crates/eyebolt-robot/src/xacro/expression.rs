//! Python expressions, as far as descriptions use them: text into a tree.

use super::error::Fault;

/// Deepest nesting.
const MAX_DEPTH: usize = 100;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Expression {
    Int(i64),
    Float(f64),
    Text(String),
    Name(String),
    List(Vec<Self>),
    Dict(Vec<(Self, Self)>),
    /// Operator and operands; `not`, `-` and `+` have one.
    Operation(&'static str, Vec<Self>),
    /// First operand, then operators with theirs: all must hold.
    Comparison(Box<Self>, Vec<(&'static str, Self)>),
    /// Value if true, condition, value if not.
    Conditional(Box<[Self; 3]>),
    Attribute(Box<Self>, String),
    Index(Box<Self>, Box<Self>),
    /// Function, arguments, arguments by name.
    Call(Box<Self>, Vec<Self>, Vec<(String, Self)>),
}

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Int(i64),
    Float(f64),
    Text(String),
    Name(String),
    Sign(&'static str),
}

const SIGNS: [&str; 25] = [
    "**", "//", "==", "!=", "<=", ">=", "<", ">", "+", "-", "*", "/", "%", "(", ")", "[", "]", "{",
    "}", ",", ":", ".", "=", "!", "@",
];

/// The tree of `text`.
pub(super) fn parse(text: &str) -> Result<Expression, Fault> {
    let mut parser = Parser { tokens: tokens(text)?, at: 0, depth: 0 };
    let first = parser.conditional()?;
    // `a, b` without parentheses is a list too.
    let mut items = vec![first];
    let mut several = false;
    while parser.take(",") {
        several = true;
        if parser.at == parser.tokens.len() {
            break;
        }
        items.push(parser.conditional()?);
    }
    if let Some(token) = parser.tokens.get(parser.at) {
        return Err(format!("unexpected {}", shown(token)).into());
    }
    match (several, items.pop()) {
        (false, Some(only)) => Ok(only),
        (_, last) => Ok(Expression::List(items.into_iter().chain(last).collect())),
    }
}

fn shown(token: &Token) -> String {
    match token {
        Token::Int(number) => format!("`{number}`"),
        Token::Float(number) => format!("`{number}`"),
        Token::Text(text) => format!("'{text}'"),
        Token::Name(name) => format!("`{name}`"),
        Token::Sign(sign) => format!("`{sign}`"),
    }
}

fn tokens(text: &str) -> Result<Vec<Token>, Fault> {
    let mut rest = text.trim_start();
    let mut tokens = Vec::new();
    while let Some(first) = rest.chars().next() {
        let second = rest.chars().nth(1);
        let numeric =
            first.is_ascii_digit() || (first == '.' && second.is_some_and(|c| c.is_ascii_digit()));
        let (token, length) = if numeric {
            number(rest)?
        } else if first.is_alphabetic() || first == '_' {
            let length =
                rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            (Token::Name(rest.get(..length).unwrap_or_default().to_owned()), length)
        } else if matches!(first, '\'' | '"') {
            quoted(rest, first)?
        } else {
            let sign = SIGNS.iter().find(|sign| rest.starts_with(**sign));
            let sign = sign.ok_or_else(|| Fault::new(format!("`{first}` is not understood")))?;
            (Token::Sign(sign), sign.len())
        };
        tokens.push(token);
        rest = rest.get(length..).unwrap_or_default().trim_start();
    }
    Ok(tokens)
}

fn number(text: &str) -> Result<(Token, usize), Fault> {
    let mut length = 0;
    let mut before = ' ';
    for letter in text.chars() {
        let exponent_sign = matches!(letter, '+' | '-') && matches!(before, 'e' | 'E');
        if !letter.is_ascii_alphanumeric() && letter != '.' && letter != '_' && !exponent_sign {
            break;
        }
        length += letter.len_utf8();
        before = letter;
    }
    let digits = text.get(..length).unwrap_or_default().replace('_', "");
    let token = match digits.parse::<i64>() {
        Ok(number) => Token::Int(number),
        Err(_) => match digits.parse::<f64>() {
            Ok(number) => Token::Float(number),
            Err(_) => return Err(format!("`{digits}` is not a number").into()),
        },
    };
    Ok((token, length))
}

fn quoted(text: &str, quote: char) -> Result<(Token, usize), Fault> {
    let mut content = String::new();
    let mut letters = text.char_indices().skip(1);
    while let Some((at, letter)) = letters.next() {
        match letter {
            '\\' => match letters.next() {
                Some((_, 'n')) => content.push('\n'),
                Some((_, 't')) => content.push('\t'),
                Some((_, other)) => content.push(other),
                None => break,
            },
            _ if letter == quote => return Ok((Token::Text(content), at + 1)),
            _ => content.push(letter),
        }
    }
    Err(format!("the text after {quote} has no end").into())
}

struct Parser {
    tokens: Vec<Token>,
    at: usize,
    depth: usize,
}

type Parsed = Result<Expression, Fault>;
/// An argument that is given by its name.
type Named = (String, Expression);

impl Parser {
    fn peek_sign(&self, signs: &[&'static str]) -> Option<&'static str> {
        match self.tokens.get(self.at) {
            Some(Token::Sign(sign)) => signs.iter().find(|known| *known == sign).copied(),
            Some(Token::Name(name)) => signs.iter().find(|known| *known == name).copied(),
            _ => None,
        }
    }

    /// Whether `sign`, or a word, comes next; it is then passed over.
    fn take(&mut self, sign: &'static str) -> bool {
        let next = self.peek_sign(&[sign]).is_some();
        self.at += usize::from(next);
        next
    }

    fn expect(&mut self, sign: &'static str) -> Result<(), Fault> {
        if self.take(sign) {
            return Ok(());
        }
        let found = self.tokens.get(self.at).map_or("the end".to_owned(), shown);
        Err(format!("`{sign}` is missing before {found}").into())
    }

    fn conditional(&mut self) -> Parsed {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err("nested too deep".into());
        }
        let value = self.either("or")?;
        let whole = if self.take("if") {
            let condition = self.either("or")?;
            self.expect("else")?;
            let other = self.conditional()?;
            Expression::Conditional(Box::new([value, condition, other]))
        } else {
            value
        };
        self.depth -= 1;
        Ok(whole)
    }

    /// `or` of `and`s of `not`s.
    fn either(&mut self, word: &'static str) -> Parsed {
        let next = |parser: &mut Self| match word {
            "or" => parser.either("and"),
            _ => parser.negation(),
        };
        let mut whole = next(self)?;
        while self.take(word) {
            let other = next(self)?;
            whole = Expression::Operation(word, vec![whole, other]);
        }
        Ok(whole)
    }

    fn negation(&mut self) -> Parsed {
        let mut negated = false;
        while self.take("not") {
            negated = !negated;
            // `not not x` is a truth too.
            if !negated && self.peek_sign(&["not"]).is_none() {
                let inner = Expression::Operation("not", vec![self.comparison()?]);
                return Ok(Expression::Operation("not", vec![inner]));
            }
        }
        let inner = self.comparison()?;
        Ok(if negated { Expression::Operation("not", vec![inner]) } else { inner })
    }

    fn comparison(&mut self) -> Parsed {
        let first = self.binary(0)?;
        let mut others = Vec::new();
        loop {
            let operator = match self.peek_sign(&["==", "!=", "<=", ">=", "<", ">", "in", "is"]) {
                Some(sign) => {
                    self.at += 1;
                    match (sign, self.peek_sign(&["not"])) {
                        ("is", Some(_)) => {
                            self.at += 1;
                            "is not"
                        }
                        _ => sign,
                    }
                }
                None if self.peek_sign(&["not"]).is_some() => {
                    self.at += 1;
                    self.expect("in")?;
                    "not in"
                }
                None => break,
            };
            others.push((operator, self.binary(0)?));
        }
        Ok(match others.is_empty() {
            true => first,
            false => Expression::Comparison(Box::new(first), others),
        })
    }

    /// Sums of products.
    fn binary(&mut self, level: usize) -> Parsed {
        const LEVELS: [&[&str]; 2] = [&["+", "-"], &["*", "/", "//", "%"]];
        let next = |parser: &mut Self| match level {
            0 => parser.binary(1),
            _ => parser.signed(),
        };
        let mut whole = next(self)?;
        while let Some(sign) = self.peek_sign(LEVELS.get(level).copied().unwrap_or_default()) {
            self.at += 1;
            let other = next(self)?;
            whole = Expression::Operation(sign, vec![whole, other]);
        }
        Ok(whole)
    }

    /// A sign binds less than a power: -2**2 is -4.
    fn signed(&mut self) -> Parsed {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err("nested too deep".into());
        }
        let whole = match self.peek_sign(&["-", "+"]) {
            Some(sign) => {
                self.at += 1;
                Expression::Operation(sign, vec![self.signed()?])
            }
            None => {
                let base = self.postfix()?;
                match self.take("**") {
                    true => Expression::Operation("**", vec![base, self.signed()?]),
                    false => base,
                }
            }
        };
        self.depth -= 1;
        Ok(whole)
    }

    fn postfix(&mut self) -> Parsed {
        let mut whole = self.atom()?;
        loop {
            if self.take("(") {
                let (given, named) = self.arguments()?;
                whole = Expression::Call(Box::new(whole), given, named);
            } else if self.take("[") {
                let index = self.conditional()?;
                self.expect("]")?;
                whole = Expression::Index(Box::new(whole), Box::new(index));
            } else if self.take(".") {
                let Some(Token::Name(name)) = self.tokens.get(self.at).cloned() else {
                    return Err("a name is missing after `.`".into());
                };
                self.at += 1;
                whole = Expression::Attribute(Box::new(whole), name);
            } else {
                return Ok(whole);
            }
        }
    }

    /// Arguments of a call, up to its `)`, and those that are named.
    fn arguments(&mut self) -> Result<(Vec<Expression>, Vec<Named>), Fault> {
        let (mut given, mut named) = (Vec::new(), Vec::new());
        while !self.take(")") {
            match (self.tokens.get(self.at), self.tokens.get(self.at + 1)) {
                (Some(Token::Name(name)), Some(Token::Sign("="))) => {
                    let name = name.clone();
                    self.at += 2;
                    named.push((name, self.conditional()?));
                }
                _ => given.push(self.conditional()?),
            }
            if !self.take(",") {
                self.expect(")")?;
                break;
            }
        }
        Ok((given, named))
    }

    /// Items up to `end`, separated by commas.
    fn items(&mut self, end: &'static str) -> Result<Vec<Expression>, Fault> {
        let mut items = Vec::new();
        while !self.take(end) {
            items.push(self.conditional()?);
            if !self.take(",") {
                self.expect(end)?;
                break;
            }
        }
        Ok(items)
    }

    fn atom(&mut self) -> Parsed {
        let token = self.tokens.get(self.at).cloned();
        self.at += 1;
        match token {
            Some(Token::Int(number)) => Ok(Expression::Int(number)),
            Some(Token::Float(number)) => Ok(Expression::Float(number)),
            Some(Token::Text(mut text)) => {
                // Texts side by side are one.
                while let Some(Token::Text(more)) = self.tokens.get(self.at) {
                    text += more;
                    self.at += 1;
                }
                Ok(Expression::Text(text))
            }
            Some(Token::Name(name)) => Ok(Expression::Name(name)),
            Some(Token::Sign("(")) => self.parenthesised(),
            Some(Token::Sign("[")) => Ok(Expression::List(self.items("]")?)),
            Some(Token::Sign("{")) => self.dictionary(),
            Some(other) => Err(format!("unexpected {}", shown(&other)).into()),
            None => Err("something is missing at the end".into()),
        }
    }

    fn parenthesised(&mut self) -> Parsed {
        if self.take(")") {
            return Ok(Expression::List(Vec::new()));
        }
        let first = self.conditional()?;
        if self.take(",") {
            let rest = self.items(")")?;
            return Ok(Expression::List(std::iter::once(first).chain(rest).collect()));
        }
        self.expect(")")?;
        Ok(first)
    }

    fn dictionary(&mut self) -> Parsed {
        let mut pairs = Vec::new();
        while !self.take("}") {
            let key = self.conditional()?;
            self.expect(":")?;
            pairs.push((key, self.conditional()?));
            if !self.take(",") {
                self.expect("}")?;
                break;
            }
        }
        Ok(Expression::Dict(pairs))
    }
}
