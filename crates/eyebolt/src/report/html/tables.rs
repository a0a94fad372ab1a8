//! Tables of an evaluation as a page.

use super::template;
use crate::evaluate::{Cell, Row, Table};
use minijinja::{Value, context};

/// A page for a browser with `tables`; `about` says what they are of and against what.
pub fn tables_page(about: &str, tables: &[Table]) -> String {
    let row = |row: &Row| {
        let cells: Vec<String> = row.cells.iter().map(Cell::text).collect();
        context! { name => row.name, cells => cells }
    };
    let table = |table: &Table| {
        let rows: Vec<Value> = table.rows.iter().map(row).collect();
        context! { title => table.title, columns => table.columns, rows => rows }
    };
    let tables: Vec<Value> = tables.iter().map(table).collect();
    let version = env!("CARGO_PKG_VERSION");
    template::render(
        "tables.html",
        context! { about => about, tables => tables, version => version },
    )
}
