# SPDX-License-Identifier: GPL-3.0-or-later
"""A page in headless Chromium at one width of its window, and what a reader would complain about."""
import contextlib
import json

from selenium import webdriver
from selenium.webdriver.chrome.service import Service

SMALLEST_TEXT = 10  # px, as displayed; in words and in pictures

LOOK = """
const found = {complaints: [], pictures: 0};
const complain = text => found.complaints.push(text);
if (document.documentElement.scrollWidth > window.innerWidth)
    complain(`the page is ${document.documentElement.scrollWidth} px wide in a window of ${window.innerWidth}`);
if (document.querySelectorAll("h1").length != 1) complain("there is not exactly one h1");
if (!document.documentElement.lang) complain("no language is given");
for (const element of document.querySelectorAll("img, script, link, iframe, source")) {
    const from = element.src || element.href || "";
    if (from && !from.startsWith("data:")) complain(`not self-contained: ${element.tagName} ${from.slice(0, 80)}`);
}
for (const picture of document.images) {
    found.pictures += 1;
    const what = picture.alt || "a picture without alt text";
    if (!picture.alt) complain(what);
    if (!picture.complete || picture.naturalWidth == 0) complain(`${what}: not loaded`);
    const text = Number(picture.dataset.smallestText || 0) * picture.getBoundingClientRect().width;
    if (picture.dataset.smallestText && text < SMALLEST) complain(`${what}: text of ${text.toFixed(1)} px`);
}
const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
for (let node; node = walker.nextNode();) {
    const box = node.parentElement;
    if (!node.data.trim() || !box.checkVisibility()) continue;
    const size = parseFloat(getComputedStyle(box).fontSize);
    if (size < SMALLEST) complain(`"${node.data.trim().slice(0, 40)}": ${size} px`);
    const range = document.createRange();
    range.selectNodeContents(node);
    if (range.getBoundingClientRect().right > window.innerWidth && !box.closest(".wide, pre"))
        complain(`"${node.data.trim().slice(0, 40)}": cut at the window's edge`);
}
return JSON.stringify(found);
"""


@contextlib.contextmanager
def chromium():
    options = webdriver.ChromeOptions()
    for switch in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars",
                   "--use-angle=swiftshader", "--enable-unsafe-swiftshader"):  # WebGL by the processor
        options.add_argument(switch)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(options=options, service=Service("/usr/bin/chromedriver"))
    try:
        yield browser
    finally:
        browser.quit()


def look(browser, file, width, screenshot=None):
    """(complaints, number of pictures) of the page; screenshot: a PNG file of the whole page."""
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                            {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False})
    browser.get(file.resolve().as_uri())
    found = json.loads(browser.execute_script(LOOK.replace("SMALLEST", str(SMALLEST_TEXT))))
    complaints = found["complaints"] + [f"console: {entry['message']}" for entry in browser.get_log("browser")
                                        if entry["level"] in ("SEVERE", "WARNING")
                                        and "GL Driver Message (OpenGL, Performance" not in entry["message"]]
    if screenshot:
        height = browser.execute_script("return document.documentElement.scrollHeight")
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
        browser.save_screenshot(str(screenshot))
    return complaints, found["pictures"]
