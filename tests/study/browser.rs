//! The report in a real browser, at a phone's width and a desktop's.

use super::example;
use headless_chrome::browser::tab::Tab;
use headless_chrome::browser::tab::point::Point;
use headless_chrome::protocol::cdp::types::Event;
use headless_chrome::protocol::cdp::{Emulation, Network};
use headless_chrome::{Browser, LaunchOptions};
use luch::study::report::html;
use serde_json::Value;
use std::ffi::OsStr;
use std::fs;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tempfile::TempDir;

/// Set to `required` where a missing browser is a failure.
const SWITCH: &str = "LUCH_TEST_BROWSER";

const WIDTHS: [u32; 2] = [390, 1280];

/// A browser with the example's page, and what it complained about and asked for.
struct Page {
    tab: Arc<Tab>,
    complaints: Arc<Mutex<Vec<String>>>,
    requests: Arc<Mutex<Vec<String>>>,
    url: String,
    // Ended and deleted last.
    _browser: Browser,
    _folder: TempDir,
}

/// Chromium by the names that systems give it.
fn chromium() -> Option<PathBuf> {
    let folders = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome"];
    std::env::split_paths(&folders)
        .flat_map(|folder| names.map(|name| folder.join(name)))
        .find(|path| path.is_file())
}

fn open(width: u32) -> Option<Page> {
    let Some(path) = chromium() else {
        let required = std::env::var_os(SWITCH).is_some_and(|value| value == "required");
        assert!(!required, "no chromium in PATH, and {SWITCH}=required");
        #[allow(
            clippy::print_stderr,
            reason = "a skipped test must not look like one that passed"
        )]
        {
            eprintln!("skipped: no chromium in PATH, the report was seen by no browser");
        }
        return None;
    };
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.html");
    fs::write(&file, html(&example::report())).unwrap();
    let url = format!("file://{}", file.display());

    let flags = [
        "--disable-quic",
        "--disable-component-update",
        "--no-default-browser-check",
    ];
    let browser = Browser::new(LaunchOptions {
        path: Some(path),
        // Root has no sandbox, nor have most containers; the page is our own.
        sandbox: false,
        window_size: Some((1280, 900)),
        user_data_dir: Some(folder.path().join("profile")),
        args: flags.map(OsStr::new).into(),
        idle_browser_timeout: Duration::from_secs(120),
        ..LaunchOptions::default()
    })
    .unwrap();
    let tab = browser.new_tab().unwrap();
    tab.set_default_timeout(Duration::from_secs(60));
    let (complaints, requests) = (Arc::default(), Arc::default());
    listen(&tab, &complaints, &requests);
    tab.call_method(metrics(width)).unwrap();
    tab.navigate_to(&url)
        .unwrap()
        .wait_until_navigated()
        .unwrap();
    Some(Page {
        tab,
        complaints,
        requests,
        url,
        _browser: browser,
        _folder: folder,
    })
}

fn listen(tab: &Tab, complaints: &Arc<Mutex<Vec<String>>>, requests: &Arc<Mutex<Vec<String>>>) {
    let (complaints, requests) = (complaints.clone(), requests.clone());
    tab.enable_runtime().unwrap().enable_log().unwrap();
    tab.call_method(Network::Enable {
        max_total_buffer_size: None,
        max_resource_buffer_size: None,
        max_post_data_size: None,
        report_direct_socket_traffic: None,
        enable_durable_messages: None,
    })
    .unwrap();
    tab.add_event_listener(Arc::new(move |event: &Event| match event {
        Event::RuntimeExceptionThrown(_)
        | Event::RuntimeConsoleAPICalled(_)
        | Event::LogEntryAdded(_) => {
            complaints.lock().unwrap().push(format!("{event:?}"));
        }
        Event::NetworkRequestWillBeSent(request) => {
            requests
                .lock()
                .unwrap()
                .push(request.params.request.url.clone());
        }
        _ => {}
    }))
    .unwrap();
}

fn metrics(width: u32) -> Emulation::SetDeviceMetricsOverride {
    Emulation::SetDeviceMetricsOverride {
        width,
        height: 900,
        device_scale_factor: 1.0,
        mobile: width < 600,
        scale: None,
        screen_width: None,
        screen_height: None,
        position_x: None,
        position_y: None,
        dont_set_visible_size: None,
        screen_orientation: None,
        viewport: None,
        display_feature: None,
        device_posture: None,
    }
}

impl Page {
    /// The value of `expression`, which becomes JSON on its way.
    fn value(&self, expression: &str) -> Value {
        let script = format!("JSON.stringify({expression})");
        let object = self.tab.evaluate(&script, false).unwrap();
        let text = object
            .value
            .unwrap_or_else(|| panic!("{expression}: {:?}", object.description));
        serde_json::from_str(text.as_str().unwrap()).unwrap()
    }

    fn numbers(&self, expression: &str) -> Vec<f64> {
        let value = self.value(expression);
        value
            .as_array()
            .unwrap()
            .iter()
            .map(|number| number.as_f64().unwrap())
            .collect()
    }

    /// Moves the pointer to the middle of what `element` is, once that is in sight.
    fn point_at(&self, element: &str) -> Point {
        let script = format!(
            "(() => {{ const e = {element}; e.scrollIntoView({{ block: 'center', behavior: 'instant' }}); \
             const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; }})()"
        );
        let at = self.numbers(&script);
        let point = Point { x: at[0], y: at[1] };
        self.tab.move_mouse_to_point(point).unwrap();
        point
    }
}

#[test]
fn the_page_opens_without_a_complaint_and_asks_for_nothing_but_itself() {
    for width in WIDTHS {
        let Some(page) = open(width) else { return };
        page.point_at("document.querySelector('footer')");
        assert_eq!(*page.complaints.lock().unwrap(), [""; 0], "{width}");
        let requests = page.requests.lock().unwrap();
        let outside = |url: &&String| **url != page.url && !url.starts_with("data:");
        assert!(requests.contains(&page.url), "{requests:?}");
        assert_eq!(requests.iter().find(outside), None, "{width}");
    }
}

#[test]
fn every_plot_and_picture_is_seen_within_its_column() {
    for width in WIDTHS {
        let Some(page) = open(width) else { return };
        let boxes = page.value(
            "[...document.querySelectorAll('.plot svg, .picture img')].map(e => { \
             const b = e.getBoundingClientRect(), c = e.closest('figure').getBoundingClientRect(); \
             return [b.width, b.height, b.left - c.left, c.right - b.right]; }).filter(([w]) => w > 0)",
        );
        let boxes: Vec<Vec<f64>> = serde_json::from_value(boxes).unwrap();
        // Of each plot one of two forms is seen.
        assert_eq!(boxes.len(), 4 + 2, "{width}");
        for seen in boxes {
            let [w, h, left, right] = seen[..] else {
                panic!("{seen:?}")
            };
            assert!(
                w > 250.0 && h > 180.0 && left > -0.5 && right > -0.5,
                "{width}: {seen:?}"
            );
        }
        let page_width = page
            .value("document.documentElement.scrollWidth")
            .as_f64()
            .unwrap();
        assert!(
            page_width <= f64::from(width),
            "{width}: the page is {page_width} wide"
        );
        let letters = page.numbers(
            "[...document.querySelectorAll('.plot svg text')].map(e => e.getBoundingClientRect().height).filter(h => h > 0)",
        );
        assert!(
            letters.len() > 40 && letters.iter().all(|height| *height > 9.0),
            "{width}: {letters:?}"
        );
    }
}

#[test]
fn a_head_sorts_numbers_up_and_then_down_and_leaves_gaps_last() {
    for width in WIDTHS {
        let Some(page) = open(width) else { return };
        let head = "document.querySelectorAll('table')[0].tHead.rows[0].cells[6]";
        let column = "[...document.querySelectorAll('table')[0].tBodies[0].rows].map(r => Number(r.cells[6].dataset.value ?? -1))";
        let sort = format!("{head}.getAttribute('aria-sort')");

        let point = page.point_at(&format!("{head}.querySelector('button')"));
        page.tab.click_point(point).unwrap();
        let up = page.numbers(column);
        assert_eq!(page.value(&sort), "ascending", "{width}");
        let (gap, values) = up.split_last().unwrap();
        assert!(
            *gap == -1.0 && values.len() == 19 && values.is_sorted() && values[0] < values[18],
            "{up:?}"
        );

        page.tab.press_key("Enter").unwrap();
        let down = page.numbers(column);
        assert_eq!(page.value(&sort), "descending", "{width}");
        let (gap, values) = down.split_last().unwrap();
        assert!(
            *gap == -1.0 && values.is_sorted_by(|a, b| a >= b),
            "{down:?}"
        );
        assert_eq!(
            page.value("document.querySelectorAll('th[aria-sort=none]').length"),
            7 + 4
        );
    }
}

#[test]
fn the_pointer_shows_a_points_values_and_takes_them_away() {
    for width in WIDTHS {
        let Some(page) = open(width) else { return };
        let circle = "[...document.querySelectorAll('.hits circle')].find(e => e.getBoundingClientRect().width > 0)";
        page.point_at(circle);
        let said = page.value("document.querySelector('#tip').innerText");
        let said = said.as_str().unwrap().replace('\u{a0}', " ");
        assert!(
            said.contains("fastest, leaf 1") && said.contains("build time: 84 ms"),
            "{width}: {said}"
        );
        let inside = page.value(
            "(() => { const b = document.querySelector('#tip').getBoundingClientRect(); \
             return b.width > 0 && b.left >= 0 && b.right <= innerWidth && b.top >= 0; })()",
        );
        assert_eq!(inside, true, "{width}");
        page.point_at("document.querySelector('h1')");
        assert_eq!(
            page.value("document.querySelector('#tip').hidden"),
            true,
            "{width}"
        );
    }
}
