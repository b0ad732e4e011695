"""Drives the pages of `lagomorph preview`: arguments are a run of nine frames at 30 fps, one without pictures, and a folder of PNGs."""
import pathlib
import sys

from webdriver import Browser, expect

run, states, pictures = (pathlib.Path(p) / "preview/index.html" for p in sys.argv[1:])
page = run.as_uri()
LAST = "frame 8 · 0.27 s"


def where(b):
    return b.text("#where")


def pixels(b):
    return b.script("return document.getElementById('view').toDataURL()")


def complaints(b):
    """But for the icon, which browsers ask for by themselves."""
    return [c for c in b.console() if "favicon" not in c]


def steps_and_scrubs(b):
    b.open(page)
    expect(b.text("h1"), "bar", "the heading")
    expect(b.text("header p"), "9 frames, 0.30 s at 30 fps, all steps converged", "the line below it")
    expect(where(b), "frame 3 · 0.10 s", "where it begins")
    b.until(lambda: len(pixels(b)) > 1000, "a picture is drawn")
    third = pixels(b)
    b.click("#next")
    expect(where(b), "frame 4 · 0.13 s", "after a step on")
    assert pixels(b) != third, "a step shows another picture"
    b.click("#back")
    expect(where(b), "frame 3 · 0.10 s", "after a step back")
    expect(pixels(b), third, "the same frame again")
    b.click_at("#scrub", 1)
    expect(where(b), LAST, "at the slider's end")
    b.click("#next")
    expect(where(b), LAST, "a step past the end")
    b.click_at("#scrub", 0)
    expect(where(b), "frame 0 · 0.00 s", "at the slider's beginning")


def keys(b):
    b.open(page)
    b.click("h1")
    for key, place in (("end", LAST), ("left", "frame 7 · 0.23 s"), ("home", "frame 0 · 0.00 s"), ("right", "frame 1 · 0.03 s")):
        b.key(key)
        expect(where(b), place, "after the key " + key)
    for key, speed in (("+", "2"), ("+", "4"), ("+", "4"), ("-", "2"), ("-", "1"), ("-", "0.5")):
        b.key(key)
        expect(b.script("return document.getElementById('speed').value"), speed, "the speed after " + key)
    b.key("space")
    expect(b.text("#play"), "Pause", "the button after the space bar")
    b.key("space")
    expect(b.text("#play"), "Play", "the button after the second one")


def plays(b):
    b.open(page)
    b.click_at("#scrub", 0)
    b.click("#play")
    expect(b.text("#play"), "Pause", "the button while it plays")
    seen = set()

    def all_seen():
        seen.add(where(b))
        return len(seen) >= 5
    b.until(all_seen, "frames go by")
    b.click("#play")
    expect(b.text("#play"), "Play", "the button once it is stopped")
    stopped = where(b)
    b.script("return new Promise(done => setTimeout(done, 200))")
    expect(where(b), stopped, "where it stopped")
    # At a tenth of its speed a frame lasts a third of a second.
    b.script("const s = document.getElementById('speed'); s.scrollIntoView(); s.focus()")
    b.click("#speed option[value='0.1']")
    b.click_at("#scrub", 0)
    took = b.script("""const frames = new Set(), begin = performance.now(); document.getElementById('play').click();
        return new Promise(done => { (function look() {
          if (document.getElementById('where').textContent.startsWith('frame 2')) done(performance.now() - begin);
          else if (performance.now() - begin > 5000) done(-1); else setTimeout(look, 5); })(); })""")
    assert 500 < took < 1500, "two frames at a tenth of 30 a second took %g ms" % took
    b.click("#view")
    expect(b.text("#play"), "Play", "the button after a click on the picture")


def links(b):
    b.open(page)
    b.click(".sheet a[data-frame='0']")
    expect(where(b), "frame 0 · 0.00 s", "after a click on the first of the sheet")
    expect(b.script("return location.hash"), "#frame=0", "the address")
    expect(b.script("return document.querySelectorAll('.sheet a.current').length"), 1, "marked in the sheet")
    b.open("about:blank")
    b.open(page + "#frame=5")
    expect(where(b), "frame 5 · 0.17 s", "by a link to the frame")


def curves(b):
    b.open(page)
    b.click_at(".chart:nth-child(1) .area", 1)
    expect(where(b), LAST, "at the energy curve's end")
    expect(b.script("return [...document.querySelectorAll('.now')].map(n => n.hidden)"), [False] * 3, "the playheads")
    expect(b.script("return document.querySelector('.now').style.left"), "100%", "the energy curve's playhead")
    b.click_at(".chart:nth-child(2) .area", 0)
    expect(where(b), "frame 0 · 0.00 s", "at the iterations' beginning")
    expect(b.text(".chart:nth-child(1) output"), "0", "kinetic energy since frame 0, in frame 0")
    expect(b.script("return document.querySelector('details').open"), False, "the scene")
    b.click("summary")
    assert "young = 20000.0" in b.text("pre"), "the scene is there once it is opened"


def needs_nothing_else(b):
    b.open(page)
    expect(b.script("return performance.getEntriesByType('resource').map(e => e.name).filter(n => !n.startsWith('data:'))"), [], "files asked for")
    expect(complaints(b), [], "complaints of the browser")


def other_folders(b):
    b.open(states.as_uri())
    assert "lagomorph render " in b.text(".remarks"), "how to draw it"
    b.hover_at(".chart:nth-child(1) .area", 0.99)
    assert float(b.text(".chart:nth-child(1) output")) > 0, "the curve's value under the mouse"
    b.open(pictures.as_uri())
    expect(b.text("h1"), pictures.parent.parent.name, "an odd name")
    assert b.script("return document.title") != "1", "no name is code"
    expect(where(b), "frame 3", "a frame without a time")
    b.key("end")
    expect(where(b), "frame 8", "the last one")
    expect(complaints(b), [], "complaints of the browser")


with Browser() as browser:
    for part in (steps_and_scrubs, keys, plays, links, curves, needs_nothing_else, other_folders):
        part(browser)
        print("ok", part.__name__)
for width in (390, 320):
    with Browser(phone=width) as browser:
        for file in (run, states, pictures):
            browser.open(file.as_uri())
            wide = browser.script("return document.documentElement.scrollWidth")
            assert wide <= width, "%s is %d wide on a phone of %d" % (file, wide, width)
        print("ok on a phone of", width)
with Browser(javascript=False) as browser:
    browser.open(page)
    expect(browser.text("h1"), "bar", "the heading without JavaScript")
    assert browser.is_shown("#still"), "a picture without JavaScript"
    assert not browser.is_shown(".controls"), "no controls without JavaScript"
    assert browser.is_shown(".sheet li:nth-child(9) img") and browser.is_shown(".chart polyline"), "frames and curves"
    print("ok without JavaScript")
