//! The random maps of the peer (`peers/planning/rooms.rs`, family "general"), number for number: `n` disjoint
//! rectangles of 0.6 to 3 m in a square of side 5 sqrt(n).

use adit_planners::geometry::Rect;

/// The square and its obstacles.
pub struct Map {
    /// The environment.
    pub bounds: Rect,
    /// Disjoint rectangles strictly inside.
    pub obstacles: Vec<Rect>,
}

/// The map of `n` obstacles that the peer makes from `seed`.
pub fn general(n: usize, seed: u64) -> Map {
    let mut random = Random::new(seed);
    let side = (5.0 * (n as f64).sqrt()).ceil().max(8.0);
    let across = (side / CELL).ceil() as usize + 1;
    let mut cells: Vec<Vec<Rect>> = vec![Vec::new(); across * across];
    let mut obstacles = Vec::with_capacity(n);
    while obstacles.len() < n {
        let (w, h) = (0.6 + 2.4 * random.unit(), 0.6 + 2.4 * random.unit());
        let (x, y) = (0.05 + random.unit() * (side - w - 0.1), 0.05 + random.unit() * (side - h - 0.1));
        let grown = Rect::new(x - GAP, y - GAP, x + w + GAP, y + h + GAP);
        let (column, row) = ((x / CELL) as usize, (y / CELL) as usize);
        let near = |at: usize| at.saturating_sub(2)..(at + 3).min(across);
        let is_clear = near(column)
            .flat_map(|i| near(row).map(move |j| i * across + j))
            .all(|cell| cells[cell].iter().all(|other| !other.overlaps(&grown)));
        if is_clear {
            let obstacle = Rect::new(x, y, x + w, y + h);
            cells[column * across + row].push(obstacle);
            obstacles.push(obstacle);
        }
    }
    Map { bounds: Rect::new(0.0, 0.0, side, side), obstacles }
}

const CELL: f64 = 4.0;
const GAP: f64 = 0.02;

/// Marsaglia's xorshift, seeded as the peer does.
struct Random(u64);

impl Random {
    fn new(seed: u64) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0xDEAD_BEEF_CAFE);
        for _ in 0..10 {
            random.next();
        }
        random
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
}
