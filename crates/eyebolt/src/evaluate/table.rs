//! A table as text, CSV or JSON.

use serde::Serialize;

/// A table of figures, with what others print beside.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Table {
    /// What it is of.
    pub title: String,
    /// What the figures of each column are, with their units.
    pub columns: Vec<String>,
    /// Its rows.
    pub rows: Vec<Row>,
}

/// A row of a [`Table`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// What it is of.
    pub name: String,
    /// A cell for each column.
    pub cells: Vec<Cell>,
}

/// A figure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Cell {
    /// The figure; `None` if there is none.
    pub value: Option<f64>,
    /// Its standard deviation, if it is a mean.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub deviation: Option<f64>,
    /// What the paper prints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub paper: Option<f64>,
    /// Whether it is a number of things.
    #[serde(skip)]
    pub is_count: bool,
}

impl Cell {
    /// Of a figure.
    pub fn of(value: impl Into<Option<f64>>) -> Self {
        Self { value: value.into(), ..Self::default() }
    }

    /// Of a number of things.
    pub fn count(count: usize) -> Self {
        Self { value: Some(count as f64), is_count: true, ..Self::default() }
    }

    /// With what the paper prints.
    pub fn beside(self, paper: Option<f64>) -> Self {
        Self { paper, ..self }
    }

    /// With its deviation, and what the paper prints in brackets.
    pub fn text(&self) -> String {
        let Self { value, deviation, paper, is_count } = self;
        let decimals = if *is_count { 0 } else { 2 };
        let number = |value: &f64| format!("{value:.decimals$}");
        let mut text = value.as_ref().map_or("–".to_owned(), number);
        if let Some(deviation) = deviation {
            text += &format!(" ± {}", number(deviation));
        }
        if let Some(paper) = paper {
            text += &format!(" ({})", number(paper));
        }
        text
    }
}

impl Table {
    /// For a person: columns side by side, what the paper prints in brackets.
    pub fn text(&self) -> String {
        let head = std::iter::once(String::new()).chain(self.columns.iter().cloned()).collect();
        let rows = self.rows.iter().map(|row| {
            let cells = row.cells.iter().map(Cell::text);
            std::iter::once(row.name.clone()).chain(cells).collect::<Vec<_>>()
        });
        let lines: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
        let width = |column: usize| {
            let cells = lines.iter().filter_map(|line| line.get(column));
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..=self.columns.len()).map(width).collect();
        let line = |line: &Vec<String>| {
            let cells = line.iter().zip(&widths).enumerate().map(|(column, (cell, width))| {
                let space = " ".repeat(width - cell.chars().count());
                if column == 0 { format!("{cell}{space}") } else { format!("{space}{cell}") }
            });
            cells.collect::<Vec<_>>().join("   ").trim_end().to_owned()
        };
        let lines: Vec<String> = lines.iter().map(line).collect();
        format!("{}\n{}\n", self.title, lines.join("\n"))
    }

    /// For a spreadsheet: a line for each figure.
    pub fn csv(&self) -> String {
        let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
        let number = |value: Option<f64>| value.map(|value| value.to_string()).unwrap_or_default();
        let line = |row: &Row, column: &String, cell: &Cell| {
            let names = [&self.title, &row.name, column].map(|name| quoted(name)).join(",");
            let Cell { value, deviation, paper, .. } = *cell;
            format!("{names},{},{},{}\n", number(value), number(deviation), number(paper))
        };
        let lines = self.rows.iter().flat_map(|row| {
            row.cells.iter().zip(&self.columns).map(move |(cell, column)| line(row, column, cell))
        });
        lines.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_in_three_forms() {
        let cell = Cell { deviation: Some(0.5), ..Cell::of(1.234) }.beside(Some(24.9));
        let row = |name: &str, cells| Row { name: name.into(), cells };
        let table = Table {
            title: "poses".into(),
            columns: vec!["mm".into(), "frames".into()],
            rows: vec![
                row("a", vec![cell, Cell::count(180)]),
                row("b \"c\"", vec![Cell::of(None), Cell::count(3)]),
            ],
        };
        assert_eq!(
            table.text(),
            "poses\n                         mm   frames\na       1.23 ± 0.50 (24.90)      180\nb \"c\"                     –        3\n"
        );
        assert_eq!(table.csv().lines().nth(2), Some("\"poses\",\"b \"\"c\"\"\",\"mm\",,,"));
        let json = serde_json::to_value(&table).unwrap();
        assert_eq!(json["rows"][0]["cells"][0]["paper"], 24.9);
    }
}
