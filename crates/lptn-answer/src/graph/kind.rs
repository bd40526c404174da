//! Formats of a drawing.

use std::path::Path;

/// Format of a drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// A picture of lines.
    #[default]
    Svg,
    /// A picture of pixels.
    Png,
    /// The network for Graphviz.
    Dot,
    /// The network for Mermaid.
    Mermaid,
    /// A whole grid for ParaView.
    Vtk,
    /// A whole grid, one line per cell.
    Csv,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Svg, Self::Png, Self::Dot, Self::Mermaid, Self::Vtk, Self::Csv];

    /// Its name.
    pub fn key(self) -> &'static str {
        ["svg", "png", "dot", "mermaid", "vtk", "csv"][self as usize]
    }

    /// The ending of its files.
    pub fn ending(self) -> &'static str {
        if self == Self::Mermaid { "mmd" } else { self.key() }
    }

    /// True if it is of a grid only.
    pub fn is_of_grid(self) -> bool {
        matches!(self, Self::Vtk | Self::Csv)
    }

    /// True if it is text that is piped into other programs.
    pub fn is_piped(self) -> bool {
        matches!(self, Self::Dot | Self::Mermaid | Self::Csv)
    }

    /// The kind that belongs to the extension of a file.
    pub fn of_ending(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "gv" => Some(Self::Dot),
            "mermaid" => Some(Self::Mermaid),
            ending => Self::ALL.into_iter().find(|kind| kind.ending() == ending),
        }
    }
}
