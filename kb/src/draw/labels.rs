//! Texts on the map that do not lie on each other. Whoever asks first gets the place.

use super::frame::{At, Block};
use super::index::Index;
use super::svg::Svg;
use super::text;

#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub size: f64,
    pub colour: &'static str,
    /// Whether it is to be seen before others.
    pub strong: bool,
    /// Whether it stands on a line and covers it.
    pub chip: bool,
}

/// Labels placed so far, and what they must leave free.
#[derive(Debug, Default)]
pub(super) struct Labels {
    taken: Index,
    walls: Index,
    svg: Svg,
}

impl Labels {
    /// Labels that rather lie beside these walls than on them.
    pub fn beside(walls: impl IntoIterator<Item = Block>) -> Self {
        let mut labels = Self::default();
        for wall in walls {
            labels.walls.add(wall);
        }
        labels
    }

    pub fn is_free(&self, block: &Block) -> bool {
        self.taken.is_free(block)
    }

    /// Keeps the box free from now on.
    pub fn take(&mut self, block: Block) {
        self.taken.add(block);
    }

    /// Keeps squares along a line free: of this side, about one a step.
    pub fn take_line(&mut self, a: At, b: At, side: f64, step: f64) {
        let count = ((b.0 - a.0).hypot(b.1 - a.1) / step).ceil().clamp(1.0, 10_000.0);
        for i in 0..=count as usize {
            let share = i as f64 / count;
            self.take(Block::about(a.0 + (b.0 - a.0) * share, a.1 + (b.1 - a.1) * share, side, side));
        }
    }

    /// Writes the text at the first centre where it lies free and inside `within`, off the walls if there is one; tells
    /// whether there was any.
    pub fn place(
        &mut self,
        content: &str,
        face: Face,
        within: &Block,
        centres: impl IntoIterator<Item = At>,
    ) -> bool {
        let (w, h) = extent(content, face.size);
        let blocks = centres.into_iter().map(|(x, y)| Block::about(x, y, w, h));
        let free: Vec<Block> = blocks.filter(|block| within.encloses(block) && self.is_free(block)).collect();
        let free = free.iter().find(|block| self.walls.is_free(block)).or(free.first()).copied();
        if let Some(block) = free {
            self.write(content, face, block.centre());
            self.take(block);
        }
        free.is_some()
    }

    /// Everything written, to be laid over the map.
    pub fn finish(self) -> Svg {
        self.svg
    }

    fn write(&mut self, content: &str, face: Face, (x, y): At) {
        let baseline = y + face.size * 0.35;
        if face.chip {
            let chip = Block::about(x, y, text::width(content, face.size) + 2.0, face.size * 1.1);
            self.svg.element("rect").block(&chip).num("rx", 3.0).attr("fill", "#ffffff").end();
        }
        let mut halo = |fill: &str, stroke: &str, width: f64| {
            self.svg
                .element("text")
                .nums([("x", x), ("y", baseline), ("font-size", face.size), ("stroke-width", width)])
                .attr("text-anchor", "middle")
                .attr("stroke-linejoin", "round")
                .attr("fill", fill)
                .attr("stroke", stroke)
                .text(content);
        };
        halo("none", "#ffffff", face.size * 0.28);
        // The font is light: a thin outline gives it the weight that print needs.
        halo(face.colour, face.colour, face.size * if face.strong { 0.05 } else { 0.03 });
    }
}

/// Width and height of a label's box.
pub(super) fn extent(content: &str, size: f64) -> At {
    (text::width(content, size) + size * 0.2, size * 1.1)
}
