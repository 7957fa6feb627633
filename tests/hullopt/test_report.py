#!/usr/bin/env python3
"""The report of a run in Chromium: on a phone, on a desk, on paper. Nothing wider than the page, no label over another, no text
under 9 pixels. Exits with 77, skipped, where there is no Chromium. usage: test_report.py HULLOPT EXAMPLES [REPORT [SHOTS]]"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

hullopt, examples = sys.argv[1:3]
browser = next((b for b in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if b), None)
if not browser:
    print("no Chromium: skipped")
    sys.exit(77)
folder = tempfile.TemporaryDirectory()
at = folder.name

# Runs in the page; rectangles of text as the reader sees them.
MEASURE = """<script>addEventListener('load', () => {
    const wrong = [], width = document.documentElement.clientWidth, seen = new Map();
    const name = t => '"' + t.trim().slice(0, 40) + '"';
    const scrolls = e => { for (; e && e !== document.body; e = e.parentElement)
        if (['auto', 'scroll'].includes(getComputedStyle(e).overflowX)) return true; return false; };
    if (document.documentElement.scrollWidth > width)
        wrong.push('the page is ' + document.documentElement.scrollWidth + ' wide, the window ' + width);
    const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    let count = 0;
    for (let n; n = texts.nextNode();) {
        const e = n.parentElement, svg = e.ownerSVGElement;
        if (!n.data.trim() || e.closest('script, style, title')) continue;
        const range = document.createRange();
        range.selectNodeContents(n);
        let size = parseFloat(getComputedStyle(e).fontSize);
        if (svg) { const m = e.getScreenCTM(); size *= Math.hypot(m.a, m.b); }
        const boxes = [...range.getClientRects()].filter(b => b.width > 0 && b.height > 0);
        if (!boxes.length) continue;
        count++;
        if (size < 9 - 1e-3) wrong.push(name(n.data) + ' has ' + size.toFixed(1) + ' px');
        for (const b of boxes)
            if ((b.right > width + 0.5 || b.left < -0.5) && !scrolls(e))
                wrong.push(name(n.data) + ' reaches from ' + b.left.toFixed(0) + ' to ' + b.right.toFixed(0));
        const owner = svg || e.closest('td, th, p, .card, h1, h2, h3, figcaption, div');
        if (svg) {
            let b = e.getBoundingClientRect(), frame = svg.getBoundingClientRect();
            if (b.left < frame.left - 1 || b.right > frame.right + 1 || b.top < frame.top - 1 || b.bottom > frame.bottom + 1)
                wrong.push(name(n.data) + ' is cut by its picture');
            /* Letters leave the upper quarter and the lower fifth of their line free. */
            const upright = b.width >= b.height || n.data.trim().length < 3, h = upright ? b.height : b.width;
            b = upright ? {left: b.left, right: b.right, top: b.top + h / 4, bottom: b.bottom - h / 5, text: n.data, of: e.closest('text')}
                        : {left: b.left + h / 4, right: b.right - h / 5, top: b.top, bottom: b.bottom, text: n.data, of: e.closest('text')};
            for (const o of seen.get(svg) || [])
                if (o.of !== b.of && Math.min(b.right, o.right) - Math.max(b.left, o.left) > 0.5 &&
                    Math.min(b.bottom, o.bottom) - Math.max(b.top, o.top) > 0.5)
                    wrong.push(name(b.text) + ' lies over ' + name(o.text));
            seen.set(svg, [...(seen.get(svg) || []), b]);
        }
    }
    parent.postMessage(JSON.stringify(
        {width: width, count: count, pictures: document.querySelectorAll('svg').length, wrong: wrong}), '*');
});</script>"""
# A window has a least width: the page stands in a frame as wide as is asked for.
FRAME = """<!DOCTYPE html><body style="margin:0"><script>addEventListener('message', e => {
    const out = document.createElement('pre'); out.id = 'measured'; out.textContent = e.data; document.body.append(out); });</script>
<iframe src="PAGE.html" style="border:0;display:block;width:WIDTHpx;height:HEIGHTpx"></iframe></body>"""


def chromium(*options):
    return subprocess.run([browser, "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                           f"--user-data-dir={at}/profile", *options], capture_output=True, text=True, timeout=240).stdout


def write(name, page, width, height):
    with open(f"{at}/{name}.html", "w") as out:
        out.write(page)
    with open(f"{at}/frame.html", "w") as out:
        out.write(FRAME.replace("PAGE", name).replace("WIDTH", str(width)).replace("HEIGHT", str(height)))


def make_report():
    with open(f"{examples}/wigley_small.yaml") as given, open(f"{at}/run.yaml", "w") as out:
        out.write(re.sub(r"(hull|shape): (\S+)", rf"\1: {examples}/\2", given.read()))
    subprocess.run([hullopt, "run", f"{at}/run.yaml", "--out", f"{at}/run"], check=True, capture_output=True)
    return f"{at}/run/report.html"


report = sys.argv[3] if len(sys.argv) > 3 else make_report()
text = open(report).read()
assert "http://" not in text.replace("http://www.w3.org/", "") and "https://" not in text, "something is fetched"
failed = False
# Paper: what `@media print` says, on A4 across, less margins of 6 mm.
for name, width, page in (("phone", 390, text), ("desk", 1280, text), ("paper", 1077, text.replace("@media print", "@media all"))):
    write(name, page.replace("</head>", MEASURE + "</head>"), width, 1000)
    dom = chromium(f"--window-size={max(width, 600)},1000", "--virtual-time-budget=20000", "--dump-dom", f"file://{at}/frame.html")
    found = re.search(r'<pre id="measured">(.*?)</pre>', dom, re.S)
    assert found, dom[-500:]
    told = json.loads(found.group(1).replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&"))
    assert told["width"] == width and told["count"] > 100 and told["pictures"] >= 5, told
    print(f"{name}: {told['count']} texts, {told['pictures']} pictures, {len(told['wrong'])} faults")
    for sentence in told["wrong"]:
        failed = True
        print("  " + sentence)
    if len(sys.argv) > 4:
        height = 12000 if width < 1000 else 7000
        write(name, page, width, height)
        chromium(f"--window-size={max(width, 500)},{height}", f"--screenshot={sys.argv[4]}/{name}.png", f"file://{at}/frame.html")
chromium(f"--print-to-pdf={at}/report.pdf", "--no-pdf-header-footer", f"file://{report if os.path.isabs(report) else os.path.abspath(report)}")
pages = len(re.findall(rb"/Type\s*/Page\b", open(f"{at}/report.pdf", "rb").read()))
print(f"printed: {pages} pages")
if len(sys.argv) > 4:
    shutil.copy(f"{at}/report.pdf", sys.argv[4])
assert not failed and 1 <= pages <= 16
