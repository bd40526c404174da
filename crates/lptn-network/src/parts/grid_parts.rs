//! Parts of the volume and of the faces of a grid that belong to its cells.

use crate::parts::grid::{Face, Grid};

impl Grid {
    /// The ring of a cell, whose cells are alike; 0 for all cells of a block.
    pub(crate) fn ring(&self, at: [usize; 3]) -> usize {
        if self.rings.is_some() { at[0] } else { 0 }
    }

    /// The part of the volume that is a cell.
    pub(crate) fn part_of_volume(&self, at: [usize; 3]) -> f64 {
        match &self.rings {
            Some(rings) => rings.part(at[0]) / (self.cells[1] * self.cells[2]) as f64,
            None => 1.0 / self.count() as f64,
        }
    }

    /// The number of parts of a face, if each were as large as the one of this cell.
    pub(crate) fn parts_of_face(&self, face: Face, at: [usize; 3]) -> f64 {
        match (&self.rings, face.axis()) {
            (Some(rings), 1) => self.cells[2] as f64 / rings.part_of_cut(at[0]),
            (Some(rings), 2) => self.cells[1] as f64 / rings.part(at[0]),
            _ => self.face_count(face) as f64,
        }
    }

    /// The parts of a uniform heat of the volume that a cell and its connected surface in the
    /// direction of r take. The heat between a node and the surface flows there, as far as the
    /// logarithmic profile between them carries it.
    pub(crate) fn heated(&self, at: [usize; 3]) -> Vec<(u32, f64)> {
        let cell = self.first + self.offset(at);
        let mut own = (cell, self.part_of_volume(at));
        let Some(rings) = &self.rings else { return vec![own] };
        let mut all = Vec::new();
        for (face, part) in [Face::INNER, Face::OUTER].into_iter().zip(rings.parts_of_faces()) {
            let ends_here = at[0] == if face.is_far() { self.cells[0] - 1 } else { 0 };
            let first = self.surfaces[face as usize].filter(|_| ends_here && part > 0.0);
            let part = part / (self.cells[1] * self.cells[2]) as f64;
            if let Some(first) = first {
                let place = u32::try_from(at[1] * self.cells[2] + at[2]).unwrap_or(u32::MAX);
                all.push((first + place, part));
                own.1 -= part;
            }
        }
        all.insert(0, own);
        all
    }
}
