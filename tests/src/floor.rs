//! Floors as a robot's laser scans them, made by a generator: crooked walls, round ones, clutter, walls eaten at by
//! noise. The same numbers make the same floor.

use std::fmt::Write as _;
use std::path::Path;

/// Metres that a pixel is wide.
pub const RESOLUTION: f64 = 0.05;

/// What kind of building.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Offices on corridors, with desks and chairs, and round rooms between.
    Offices,
    /// Rows of racks, with pallets left in the aisles.
    Warehouse,
}

/// An occupancy map. Row 0 is the lowest.
pub struct Floor {
    /// Pixels along x.
    pub columns: usize,
    /// Pixels along y.
    pub rows: usize,
    walls: Vec<bool>,
    seed: u64,
}

impl Floor {
    /// Makes a floor.
    pub fn new(kind: Kind, columns: usize, rows: usize, seed: u64) -> Self {
        let mut floor = Self { columns, rows, walls: vec![false; columns * rows], seed: seed.max(1) };
        let (x1, y1) = (columns as f64 - 3.0, rows as f64 - 3.0);
        for (a, b) in
            [((2.0, 2.0), (x1, 4.0)), ((x1, 4.0), (x1 - 2.0, y1)), ((x1 - 2.0, y1), (3.0, y1 - 2.0))]
        {
            floor.wall(a, b, 3.0);
        }
        floor.wall((3.0, y1 - 2.0), (2.0, 2.0), 3.0);
        match kind {
            Kind::Offices => floor.offices(),
            Kind::Warehouse => floor.warehouse(),
        }
        floor.fray();
        floor
    }

    /// Offices of about 4 x 5 m on both sides of corridors of 2.2 m, and here and there a round room in their place.
    fn offices(&mut self) {
        let (deep, corridor) = (100.0, 44.0);
        let mut y = 4.0;
        while y + deep + corridor < self.rows as f64 {
            for (base, front) in [(y, y + deep), (y + 2.0 * deep + corridor, y + deep + corridor)] {
                if base < self.rows as f64 {
                    self.row_of_offices(base, front);
                }
            }
            y += 2.0 * deep + corridor + 4.0;
        }
    }

    fn row_of_offices(&mut self, base: f64, front: f64) {
        let mut x = 4.0;
        while x + 70.0 < self.columns as f64 {
            let wide = 70.0 + 40.0 * self.random();
            let (tilt, door, gap) =
                (self.about(2.0), x + 8.0 + 20.0 * self.random(), 17.0 + 6.0 * self.random());
            let bend = self.about(1.5);
            self.wall((x, front), (door, front + bend), 3.0);
            self.wall((door + gap, front + bend), (x + wide, front), 3.0);
            self.wall((x + wide, base), (x + wide + tilt, front), 3.0);
            let middle = (x + wide / 2.0, f64::midpoint(base, front));
            if self.random() < 0.15 {
                let radius = 26.0 + 6.0 * self.random();
                self.ring(middle, radius, 2.0);
            } else {
                self.furnish(middle, wide);
            }
            if self.random() < 0.2 {
                let round = 2.0 + 3.0 * self.random();
                self.disc((x + wide / 3.0, front + (front - base).signum() * 6.0), round);
            }
            x += wide;
        }
    }

    fn furnish(&mut self, (x, y): (f64, f64), wide: f64) {
        for _ in 0..3 {
            let at = (x + self.about(wide / 3.0), y + self.about(30.0));
            let turn = if self.random() < 0.6 { self.about(0.06) } else { self.about(1.5) };
            let (long, broad) = (16.0 + 14.0 * self.random(), 8.0 + 6.0 * self.random());
            self.block(at, (long, broad), turn);
            let chair = (at.0 + self.about(20.0), at.1 + self.about(14.0));
            let seat = 2.0 + 2.5 * self.random();
            self.disc(chair, seat);
        }
    }

    /// Racks 1.1 m deep and aisles of 2.5 m, with an open field of pallets at one end.
    fn warehouse(&mut self) {
        let (columns, rows) = (self.columns as f64, self.rows as f64);
        let mut y = 60.0;
        while y + 70.0 < rows {
            let mut x = 80.0;
            while x + 160.0 < columns * 0.75 {
                let tilt = self.about(0.012);
                self.block((x + 75.0, y), (150.0, 22.0), tilt);
                for foot in [0.0, 150.0] {
                    let off = self.about(1.0);
                    self.disc((x + foot, y + off), 13.0);
                }
                if self.random() < 0.35 {
                    let (turn, across) = (self.about(1.6), 30.0 + self.about(8.0));
                    let along = 150.0 * self.random();
                    self.block((x + along, y + across), (24.0, 16.0), turn);
                }
                x += 200.0;
            }
            y += 72.0;
        }
        let pallets = (columns * rows / 12_000.0) as usize;
        for _ in 0..pallets {
            let at = (columns * (0.78 + 0.2 * self.random()), rows * self.random());
            let turn = self.about(1.6);
            self.block(at, (24.0, 16.0), turn);
        }
        for column in 1..(columns / 220.0) as usize {
            for row in 1..(rows / 220.0) as usize {
                self.disc((column as f64 * 220.0, row as f64 * 220.0 - 10.0), 5.5);
            }
        }
    }

    fn wall(&mut self, a: (f64, f64), b: (f64, f64), thick: f64) {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        self.block((f64::midpoint(a.0, b.0), f64::midpoint(a.1, b.1)), (dx.hypot(dy), thick), dy.atan2(dx));
    }

    fn block(&mut self, at: (f64, f64), (long, broad): (f64, f64), turn: f64) {
        let (sin, cos) = turn.sin_cos();
        self.fill(at, long.hypot(broad) / 2.0, |dx, dy| {
            (cos * dx + sin * dy).abs() <= long / 2.0 && (cos * dy - sin * dx).abs() <= broad / 2.0
        });
    }

    fn disc(&mut self, at: (f64, f64), radius: f64) {
        self.fill(at, radius, |dx, dy| dx.hypot(dy) <= radius);
    }

    /// A round wall with an opening to the right.
    fn ring(&mut self, at: (f64, f64), radius: f64, thick: f64) {
        self.fill(at, radius + thick, |dx, dy| {
            (dx.hypot(dy) - radius).abs() <= thick && (dx < 0.0 || dy.abs() > 11.0)
        });
    }

    fn fill(&mut self, (x, y): (f64, f64), reach: f64, is_in: impl Fn(f64, f64) -> bool) {
        let range = |at: f64, count: usize| {
            ((at - reach - 1.0).max(0.0) as usize).min(count)
                ..((at + reach + 2.0).max(0.0) as usize).min(count)
        };
        for row in range(y, self.rows) {
            for column in range(x, self.columns) {
                if is_in(column as f64 + 0.5 - x, row as f64 + 0.5 - y) {
                    self.walls[row * self.columns + column] = true;
                }
            }
        }
    }

    /// One in twelve of the pixels beside a wall is a wall too.
    fn fray(&mut self) {
        let solid = self.walls.clone();
        for cell in self.columns..solid.len() - self.columns {
            let beside = [cell - 1, cell + 1, cell - self.columns, cell + self.columns];
            if !solid[cell] && beside.iter().any(|&other| solid[other]) && self.random() < 1.0 / 12.0 {
                self.walls[cell] = true;
            }
        }
    }

    /// Metres along x.
    pub fn width(&self) -> f64 {
        self.columns as f64 * RESOLUTION
    }

    /// Metres along y.
    pub fn depth(&self) -> f64 {
        self.rows as f64 * RESOLUTION
    }

    /// Evenly from 0 to 1 (xorshift).
    fn random(&mut self) -> f64 {
        self.seed ^= self.seed << 13;
        self.seed ^= self.seed >> 7;
        self.seed ^= self.seed << 17;
        (self.seed >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn about(&mut self, most: f64) -> f64 {
        (2.0 * self.random() - 1.0) * most
    }

    /// Writes a site of it: a ROS map with its image, and so many states of one robot.
    pub fn write_site(&self, folder: &Path, states: usize) -> std::io::Result<()> {
        let mut image = format!("P5\n{} {}\n255\n", self.columns, self.rows).into_bytes();
        for row in self.walls.chunks_exact(self.columns).rev() {
            image.extend(row.iter().map(|wall| if *wall { 0 } else { 254 }));
        }
        std::fs::write(folder.join("map.pgm"), image)?;
        let yaml = format!(
            "image: map.pgm\nresolution: {RESOLUTION}\norigin: [0.0, 0.0, 0.0]\nnegate: 0\n\
             occupied_thresh: 0.65\nfree_thresh: 0.196\n"
        );
        std::fs::write(folder.join("map.yaml"), yaml)?;
        std::fs::write(folder.join("site.toml"), self.site())?;
        std::fs::write(folder.join("robots.toml"), robots(states))
    }

    fn site(&self) -> String {
        let (wide, tall) = (self.columns as f64 * RESOLUTION, self.rows as f64 * RESOLUTION);
        let mut text = "name = \"floor\"\nmap = \"map.yaml\"\nstarts = []\n".to_owned();
        for (pipe, height) in [(0.3, 1.3), (0.6, 0.8)] {
            let (x, y) = (wide * pipe, tall * 0.2);
            writeln!(
                text,
                "[[bridge]]\nrect = [{x:.2}, {y:.2}, {:.2}, {:.2}]\nheight = {height}",
                x + 0.6,
                tall * 0.8
            )
            .expect("written to a string");
        }
        text
    }
}

/// States of many sizes, the first ones those of a person; the later one stands the harder it is.
fn robots(states: usize) -> String {
    const SIZES: [(&str, f64, f64); 8] = [
        ("WALK", 1.7, 0.6),
        ("SIDE-WALK", 1.7, 0.35),
        ("SQUAT", 1.1, 0.8),
        ("LIE", 0.6, 0.8),
        ("SPREAD", 1.7, 1.0),
        ("TIPTOE", 1.8, 0.45),
        ("LOADED", 1.6, 0.7),
        ("TOWING", 1.5, 0.9),
    ];
    let of_a_person = SIZES.iter().map(|&(name, height, width)| (name.to_owned(), height, width));
    // all heights with all widths, in steps that no two have in common
    let further = (0..).map(|more| {
        let (height, width) = (0.5 + 0.27 * f64::from(more % 5), 0.3 + 0.025 * f64::from(more * 7 % 30));
        (format!("SHAPE-{more}"), height, width)
    });
    let sizes: Vec<(String, f64, f64)> = of_a_person.chain(further).take(states).collect();
    let mut text = String::new();
    for (index, (state, height, width)) in sizes.iter().enumerate() {
        let hardness = 1.0 + index as f64 / 2.0;
        writeln!(
            text,
            "[[robots]]\nstate = \"{state}\"\naction = \"{state}\"\nheight = {height}\nwidth = {width}\n\
             hardness = {hardness}"
        )
        .expect("written to a string");
    }
    for (a, _, _) in &sizes {
        for (b, _, _) in sizes.iter().filter(|(b, _, _)| a != b) {
            writeln!(text, "[[changes]]\nfrom_state = \"{a}\"\nto_state = \"{b}\"\nhardness = 1.0")
                .expect("written to a string");
        }
    }
    text
}
