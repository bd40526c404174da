//! The answer of a command.
//!
//! A page is queried, not filled. The result of a command implements `Page`, and each format asks
//! only for the part that it writes. Large objects are not made for a terminal, and rows are
//! streamed.

use std::io;

use lptn_plot::Figure;

use crate::json::Json;
use crate::report::Report;
use crate::rows::Rows;
use crate::text::Text;

/// The answer of a command, for readers and for programs.
/// Each format asks only for the part that it writes.
pub trait Page {
    /// For reading: title, tables, notes, verdict.
    fn text(&self) -> Text;

    /// For spreadsheets and plots: rows of exact numbers. Default: none.
    fn rows(&self) -> Rows<'_> {
        Rows::Columns(Vec::new())
    }

    /// For programs: the members of one object, in their order.
    ///
    /// # Errors
    /// Errors of the stream.
    fn json(&self, json: &mut Json<'_>) -> io::Result<()>;

    /// For looking at: the figures that `--plot` draws. Default: none.
    fn figures(&self) -> Vec<Figure> {
        Vec::new()
    }

    /// Additions for a report: claims of how far the result can be trusted, and further sections.
    /// The title of the report is that of the text.
    fn more(&self) -> Report {
        Report::default()
    }

    /// Reason why the answer is no, if it is.
    /// The text ends with it; other formats report it separately.
    fn no(&self) -> Option<String> {
        None
    }
}

/// An answer whose page is that of one of its parts.
pub trait PageOf {
    /// The page of the part.
    fn page(&self) -> &dyn Page;
}

impl<T: PageOf> Page for T {
    fn text(&self) -> Text {
        self.page().text()
    }

    fn rows(&self) -> Rows<'_> {
        self.page().rows()
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        self.page().json(json)
    }

    fn figures(&self) -> Vec<Figure> {
        self.page().figures()
    }

    fn more(&self) -> Report {
        self.page().more()
    }

    fn no(&self) -> Option<String> {
        self.page().no()
    }
}

/// A text has nothing for programs.
impl Page for Text {
    fn text(&self) -> Text {
        self.clone()
    }

    fn json(&self, _: &mut Json<'_>) -> io::Result<()> {
        Ok(())
    }
}
