use super::*;

fn point(x: f64, y: f64) -> Point {
    Point {
        x,
        y,
        low: y,
        high: y,
        ..Point::default()
    }
}

fn plot(scale: Scale, points: Vec<Point>) -> Plot {
    let axis = Axis {
        label: "time".into(),
        unit: "s".into(),
        scale,
    };
    Plot {
        x: axis.clone(),
        y: axis,
        series: vec![Series {
            points,
            ..Series::default()
        }],
        ..Plot::default()
    }
}

#[test]
fn points_without_a_place_are_left_out_and_counted() {
    let plot = plot(
        Scale::Log,
        vec![
            point(1.0, 2.0),
            point(0.0, 1.0),
            point(1.0, -1.0),
            point(f64::NAN, 1.0),
        ],
    );
    assert_eq!(svg(&plot).matches("<title>").count(), 1);
    assert_eq!(
        plot.left_out(),
        "2 points are left out, which a logarithmic axis cannot show: not above zero. \
         1 point is left out: no finite number."
    );
    assert!(svg(&plot).contains("2 points are left out"));
}

#[test]
fn a_plot_that_shows_everything_says_nothing() {
    assert_eq!(plot(Scale::Linear, vec![point(-1.0, 0.0)]).left_out(), "");
}

#[test]
fn odd_numbers_still_make_a_plot() {
    let odd = [
        0.0,
        -0.0,
        1e-310,
        1.0,
        -1.0,
        1e99,
        1e308,
        f64::MAX,
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
    ];
    for scale in [Scale::Linear, Scale::Log] {
        for style in [
            Style::Points,
            Style::Line,
            Style::LineAndPoints,
            Style::Dashed,
        ] {
            let mut points = Vec::new();
            for x in odd {
                for y in odd {
                    points.push(Point {
                        x,
                        y,
                        low: x,
                        high: y,
                        marked: x == y,
                        label: "odd".into(),
                    });
                }
            }
            let mut plot = plot(scale, points);
            plot.series[0].style = style;
            assert!(svg(&plot).ends_with("</svg>\n"));
            assert!(!svg(&plot).contains("NaN") && !svg(&plot).contains("inf"));
        }
    }
}

#[test]
fn a_plot_without_data_says_so() {
    let mut plot = plot(Scale::Log, Vec::new());
    assert!(svg(&plot).contains("no data"));
    plot.series.clear();
    assert!(svg(&plot).contains("no data"));
}

#[test]
fn text_stays_text_and_cannot_leave_its_element() {
    let mut plot = plot(
        Scale::Linear,
        vec![Point {
            label: "<b>&".into(),
            ..point(1.0, 1.0)
        }],
    );
    plot.title = "</svg><script>".into();
    let svg = svg(&plot);
    assert!(svg.contains("&lt;/svg&gt;&lt;script&gt;") && svg.contains("&lt;b&gt;&amp;"));
    assert!(!svg.contains("<script>"));
    assert!(svg.contains("font-family=\"system-ui, sans-serif\""));
}

#[test]
fn the_pointer_is_told_value_unit_and_spread() {
    let mut plot = plot(
        Scale::Linear,
        vec![Point {
            low: 0.009,
            high: 0.0125,
            label: "leaf 4".into(),
            ..point(2.0, 0.01)
        }],
    );
    plot.x.unit = "Mrays/s".into();
    plot.x.label = "speed".into();
    let svg = svg(&plot).replace('\u{a0}', " ");
    assert!(
        svg.contains("<title>leaf 4\nspeed: 2 Mrays/s\ntime: 10 ms (9 ms to 12.5 ms)</title>"),
        "{svg}"
    );
}

#[test]
fn the_bitmap_is_1600_pixels_wide() -> std::io::Result<()> {
    let png = png(&plot(Scale::Linear, vec![point(1.0, 1.0)]))?;
    assert_eq!(png[16..20], 1600u32.to_be_bytes());
    Ok(())
}
