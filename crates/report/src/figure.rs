//! What a figure shows.

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it measures, with the unit in brackets.
    pub label: String,
    /// Logarithmic; values that are not positive are left out.
    pub log: bool,
    /// Ends; none: those of the data.
    pub range: Option<(f64, f64)>,
    /// Counts something: ticks only at whole numbers.
    pub whole: bool,
}

/// How the points of a series are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stroke {
    /// Connected.
    Line,
    /// Connected by dashes.
    Dashes,
    /// A ring at each point.
    Rings,
    /// A cross at each point.
    Crosses,
    /// A small filled square at each point.
    Squares,
    /// The polygon through the points, filled.
    Area,
}

/// Red, green, blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color(pub u8, pub u8, pub u8);

impl Color {
    /// For references: what the rest is compared with.
    pub const INK: Self = Self(30, 30, 30);
    /// For what stands behind the rest: single runs beneath their median.
    pub const CONTEXT: Self = Self(168, 180, 192);
    /// Distinct for readers with any colour vision (Okabe and Ito 2008), in order of use.
    pub const PALETTE: [Self; 6] = [
        Self(0, 114, 178),
        Self(213, 94, 0),
        Self(0, 158, 115),
        Self(204, 121, 167),
        Self(86, 180, 233),
        Self(230, 159, 0),
    ];
}

/// Points that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend; empty: not in the legend.
    pub name: String,
    /// (x, y); a point that is not finite interrupts a line.
    pub points: Vec<(f64, f64)>,
    /// How they are drawn.
    pub stroke: Stroke,
    /// Their colour.
    pub color: Color,
    /// What each point stands for, as rows of the [entries](crate::Page::entries) of the page; empty: nothing.
    pub entries: Vec<usize>,
    /// The moment of each point of a path, s; empty where there is none.
    pub times: Vec<f64>,
}

/// A diagram of y over x.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Title.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// What is drawn, the first at the bottom.
    pub series: Vec<Series>,
    /// A sentence beneath.
    pub caption: String,
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// A unit is as long on both axes: of paths in a plane.
    pub equal: bool,
    /// Figures of a page with the same name here have one horizontal axis: zoomed and read together. Empty: alone.
    pub shared: String,
    /// Figures of a page with the same name here have one vertical scale while the reader wants it. Empty: none.
    pub scale: String,
    /// Points that are marked with their value, and the series that each lies on.
    pub peaks: Vec<(usize, (f64, f64))>,
    /// Settings of runs that the axes stand for, name and unit: a page that computes may go anywhere between its points.
    pub settings: Option<[(String, String); 2]>,
}

impl Figure {
    /// An empty diagram with linear axes.
    pub fn new(title: impl Into<String>, x: impl Into<String>, y: impl Into<String>) -> Self {
        let axis = |label: String| Axis { label, log: false, range: None, whole: false };
        Self {
            title: title.into(),
            x: axis(x.into()),
            y: axis(y.into()),
            series: Vec::new(),
            caption: String::new(),
            size: (640, 360),
            equal: false,
            shared: String::new(),
            scale: String::new(),
            peaks: Vec::new(),
            settings: None,
        }
    }

    /// Adds a series in the next colour of the palette.
    #[must_use]
    pub fn series(
        self,
        name: impl Into<String>,
        stroke: Stroke,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let used = self.series.iter().filter(|s| s.color != Color::INK).count();
        let color = Color::PALETTE[used % Color::PALETTE.len()];
        self.colored(name, stroke, color, points)
    }

    /// Adds a series in a colour of its own.
    #[must_use]
    pub fn colored(
        mut self,
        name: impl Into<String>,
        stroke: Stroke,
        color: Color,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let points = points.into_iter().collect();
        let (entries, times) = (Vec::new(), Vec::new());
        self.series.push(Series { name: name.into(), points, stroke, color, entries, times });
        self
    }

    /// Says what the points of the last series stand for: rows of the [entries](crate::Page::entries) of the page.
    #[must_use]
    pub fn standing_for(mut self, rows: impl IntoIterator<Item = usize>) -> Self {
        if let Some(last) = self.series.last_mut() {
            last.entries = rows.into_iter().collect();
        }
        self
    }

    /// Says when the points of the last series were passed, s.
    #[must_use]
    pub fn at_times(mut self, times: impl IntoIterator<Item = f64>) -> Self {
        if let Some(last) = self.series.last_mut() {
            last.times = times.into_iter().collect();
        }
        self
    }

    /// Marks a point of the last series with its value.
    #[must_use]
    pub fn peak(mut self, at: (f64, f64)) -> Self {
        self.peaks.push((self.series.len().saturating_sub(1), at));
        self
    }

    /// Marks the largest magnitude of every line.
    #[must_use]
    pub fn peaks(mut self) -> Self {
        for (i, series) in self.series.iter().enumerate().filter(|(_, s)| s.stroke == Stroke::Line)
        {
            let all = series.points.iter().filter(|p| p.0.is_finite() && p.1.is_finite());
            let most = all.copied().reduce(|a, b| if b.1.abs() > a.1.abs() { b } else { a });
            self.peaks.extend(most.filter(|p| p.1 != 0.0).map(|p| (i, p)));
        }
        self
    }

    /// Over the time of the page: zoomed and read together with all others that are.
    #[must_use]
    pub fn timed(self) -> Self {
        self.shared("time")
    }

    /// With one horizontal axis for all figures of the page with this name; see [`Figure::shared`].
    #[must_use]
    pub fn shared(mut self, name: impl Into<String>) -> Self {
        self.shared = name.into();
        self
    }

    /// With one vertical scale for all figures of the page with this name; see [`Figure::scale`].
    #[must_use]
    pub fn scaled(mut self, name: impl Into<String>) -> Self {
        self.scale = name.into();
        self
    }

    /// Says which settings its axes stand for, name and unit of each.
    #[must_use]
    pub fn setting(mut self, x: (String, String), y: (String, String)) -> Self {
        self.settings = Some([x, y]);
        self
    }

    /// Makes a unit as long on both axes.
    #[must_use]
    pub fn equal(mut self) -> Self {
        self.equal = true;
        self
    }

    /// Adds a line in the next colour.
    #[must_use]
    pub fn line(
        self,
        name: impl Into<String>,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        self.series(name, Stroke::Line, points)
    }

    /// Adds a curve that the rest is compared with: dark and dashed.
    #[must_use]
    pub fn reference(
        self,
        name: impl Into<String>,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        self.colored(name, Stroke::Dashes, Color::INK, points)
    }

    /// Adds single values that the rest is compared with: dark rings.
    #[must_use]
    pub fn marks(
        self,
        name: impl Into<String>,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        self.colored(name, Stroke::Rings, Color::INK, points)
    }

    /// Makes both axes logarithmic.
    #[must_use]
    pub fn log_log(mut self) -> Self {
        self.x.log = true;
        self.y.log = true;
        self
    }

    /// Makes the horizontal axis logarithmic.
    #[must_use]
    pub fn log_x(mut self) -> Self {
        self.x.log = true;
        self
    }

    /// Makes the vertical axis logarithmic.
    #[must_use]
    pub fn log_y(mut self) -> Self {
        self.y.log = true;
        self
    }

    /// Makes the horizontal axis count.
    #[must_use]
    pub fn whole_x(mut self) -> Self {
        self.x.whole = true;
        self
    }

    /// Sets the ends of the axes.
    #[must_use]
    pub fn ranges(mut self, x: (f64, f64), y: (f64, f64)) -> Self {
        self.x.range = Some(x);
        self.y.range = Some(y);
        self
    }

    /// Sets width and height, px.
    #[must_use]
    pub fn sized(mut self, width: u32, height: u32) -> Self {
        self.size = (width, height);
        self
    }

    /// Adds a sentence beneath.
    #[must_use]
    pub fn caption(mut self, text: impl Into<String>) -> Self {
        self.caption = text.into();
        self
    }

    /// The figure as an SVG element.
    #[must_use]
    pub fn svg(&self) -> String {
        crate::draw::svg(self)
    }

    /// Several figures side by side as one SVG.
    #[must_use]
    pub fn sheet(figures: &[Self]) -> String {
        crate::draw::sheet(figures)
    }
}
