//! The page itself, from its title down to how to repeat the study.

use super::{Picture, Report, escape, table};
use crate::study::plot::{self, Plot};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

const STYLE: &str = include_str!("../../../assets/report/style.css");
const SCRIPT: &str = include_str!("../../../assets/report/script.js");

/// Whatever a name in the report smuggles in, the browser asks for nothing outside this file.
const POLICY: &str =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// The whole page.
pub(super) fn html(report: &Report) -> String {
    let title = escape(&report.title);
    let parts = [
        opening(report),
        section("plots", "Plots", report.plots.iter().map(figure)),
        section("pictures", "Pictures", groups(&report.pictures)),
        section("tables", "Tables", report.tables.iter().map(table::html)),
        closing(report),
    ];
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <link rel=\"icon\" href=\"data:,\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n\
         {}</main>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n",
        parts.concat()
    )
}

/// Title, answers, doubts, and what the numbers depend on.
fn opening(report: &Report) -> String {
    let mut out = format!("<header>\n<h1>{}</h1>\n", escape(&report.title));
    if report.partial {
        out += "<p class=\"partial\" role=\"note\"><strong>Partial.</strong> This study was interrupted: it shows the runs \
                that were finished, and its answers may change with the rest.</p>\n";
    }
    for (i, finding) in report.findings.iter().enumerate() {
        let class = if i == 0 { "lead" } else { "finding" };
        out += &format!("<p class=\"{class}\">{}</p>\n", escape(finding));
    }
    if !report.warnings.is_empty() {
        let items = report
            .warnings
            .iter()
            .map(|warning| format!("<li>{}</li>\n", escape(warning)));
        out += &format!(
            "<aside class=\"warnings\">\n<h2>Read with care</h2>\n<ul>\n{}</ul>\n</aside>\n",
            items.collect::<String>()
        );
    }
    if !report.circumstances.is_empty() {
        let pairs = report.circumstances.iter().map(|(name, value)| {
            format!(
                "<div><dt>{}</dt><dd>{}</dd></div>\n",
                escape(name),
                escape(value)
            )
        });
        out += &format!(
            "<dl class=\"circumstances\">\n{}</dl>\n",
            pairs.collect::<String>()
        );
    }
    out + "</header>\n"
}

/// A section with a heading, or nothing where it would be empty.
fn section(class: &str, heading: &str, parts: impl Iterator<Item = String>) -> String {
    let parts: String = parts.collect();
    if parts.is_empty() {
        return parts;
    }
    format!("<section class=\"{class}\">\n<h2>{heading}</h2>\n{parts}</section>\n")
}

fn figure(plot: &Plot) -> String {
    let [wide, narrow] = plot::in_page(plot);
    let caption = [plot.caption.clone(), plot.left_out()]
        .into_iter()
        .filter(|sentence| !sentence.is_empty())
        .collect::<Vec<_>>()
        .join(" ");
    format!(
        "<figure class=\"plot\">\n<h3>{}</h3>\n<div class=\"wide\">{wide}</div>\n<div class=\"narrow\">{narrow}</div>\n\
         <figcaption>{}</figcaption>\n</figure>\n",
        escape(&plot.title),
        escape(&caption)
    )
}

/// Pictures of one group within one box.
fn groups(pictures: &[Picture]) -> impl Iterator<Item = String> {
    let together = |a: &Picture, b: &Picture| !a.group.is_empty() && a.group == b.group;
    pictures.chunk_by(together).map(|group| {
        let heading = match group {
            [first, ..] if !first.group.is_empty() => {
                format!("<h3>{}</h3>\n", escape(&first.group))
            }
            _ => String::new(),
        };
        let figures: String = group.iter().map(picture).collect();
        format!("{heading}<div class=\"group\">\n{figures}</div>\n")
    })
}

fn picture(picture: &Picture) -> String {
    format!(
        "<figure class=\"picture\">\n<img alt=\"{name}\" src=\"data:image/png;base64,{}\">\n\
         <figcaption><strong>{name}</strong> {}</figcaption>\n</figure>\n",
        STANDARD.encode(&picture.png),
        escape(&picture.caption),
        name = escape(&picture.name),
    )
}

fn closing(report: &Report) -> String {
    let commands = report
        .repeat
        .iter()
        .map(|command| escape(command))
        .collect::<Vec<_>>();
    if commands.is_empty() {
        return String::new();
    }
    format!(
        "<footer>\n<h2>How to repeat it</h2>\n<pre tabindex=\"0\"><code>{}</code></pre>\n</footer>\n",
        commands.join("\n")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a hostile name would be.
    const NAME: &str = "\"><img src=//evil onerror=alert(1)>'&";

    fn hostile() -> Report {
        let name = || NAME.to_string();
        let mut plot = Plot {
            title: name(),
            caption: name(),
            ..Plot::default()
        };
        plot.x.label = name();
        plot.y.label = name();
        plot.series = vec![
            plot::Series {
                name: name(),
                points: vec![plot::Point {
                    x: 1.0,
                    y: 1.0,
                    low: 1.0,
                    high: 1.0,
                    label: name(),
                    marked: true
                }],
                ..Default::default()
            };
            2
        ];
        Report {
            title: name(),
            partial: true,
            findings: vec![name(); 2],
            circumstances: vec![(name(), name())],
            warnings: vec![name()],
            plots: vec![plot],
            pictures: vec![Picture {
                name: name(),
                group: name(),
                caption: name(),
                png: vec![1],
            }],
            tables: vec![super::super::Table {
                title: name(),
                ..Default::default()
            }],
            repeat: vec![name()],
        }
    }

    #[test]
    fn no_text_of_a_report_becomes_a_tag() {
        let page = html(&hostile());
        assert!(!page.contains("<img src=//evil"));
        assert!(page.matches("&lt;img src=//evil").count() > 15);
    }

    #[test]
    fn nothing_outside_the_page_is_named() {
        let page = html(&hostile()).replace("http://www.w3.org/2000/svg", "");
        assert!(!page.contains("http:") && !page.contains("https:"));
        assert!(!page.contains("@import") && !page.contains("url("));
    }

    #[test]
    fn a_partial_study_says_so_before_its_findings_and_a_complete_one_does_not() {
        let mut report = hostile();
        report.findings = vec!["Leaf size four is fastest.".into()];
        let page = html(&report);
        let at = |text: &str| page.find(text);
        assert!(
            at("<p class=\"partial\"").is_some_and(|partial| Some(partial) < at("Leaf size four"))
        );
        report.partial = false;
        assert!(!html(&report).contains("<p class=\"partial\""));
    }

    #[test]
    fn consecutive_pictures_of_a_group_share_a_box() {
        let of = |group: &str| Picture {
            group: group.into(),
            ..Picture::default()
        };
        let boxes: Vec<String> = groups(&[of("a"), of("a"), of("b"), of(""), of("")]).collect();
        let figures: Vec<usize> = boxes
            .iter()
            .map(|html| html.matches("<figure").count())
            .collect();
        assert_eq!(figures, [2, 1, 1, 1]);
    }

    #[test]
    fn an_empty_report_is_a_page_without_empty_sections() {
        let page = html(&Report::default());
        assert!(page.ends_with("</html>\n") && !page.contains("<h2>"));
    }
}
