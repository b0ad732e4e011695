"""Drives report.html of `lagomorph check`: of a run that differs, the same with --assets, and of one that passes; nine frames each."""
import pathlib
import sys

from webdriver import Browser, expect

bad, assets, good = (pathlib.Path(p) for p in sys.argv[1:])
page = bad.as_uri()


def where(b):
    return b.text("#where").split()[1]


def pixels(b, canvas="left"):
    return b.script("return document.getElementById(arguments[0]).toDataURL()", canvas)


def view(b):
    return b.script("return [...document.querySelectorAll('#views .on')].map(e => e.dataset.view)")


def link(b):
    return b.script("return location.hash")


def steps(b):
    b.open(page)
    b.click_at("#scrub", 0)
    expect(where(b), "0", "at the scrubber's beginning")
    b.click("#next")
    expect(where(b), "1", "after a step on")
    b.click("#back")
    expect(where(b), "0", "after a step back")
    b.click_at("#scrub", 1)
    expect(where(b), "8", "at the scrubber's end")
    b.click("#bad")
    first = b.script("return document.getElementById('viewer').dataset.failing.split(' ')[0]")
    expect(where(b), first, "the next failing frame after the last is the first")
    b.click_at(".chart .area", 1)
    expect(where(b), "8", "at the curve's end")


def views(b):
    b.open(page + "#frame=8")
    seen = {}
    for name in ("side", "slider", "diff", "heat", "blink"):
        b.click("#views [data-view='%s']" % name)
        expect(view(b), [name], "the view")
        assert "view=" + name in link(b), link(b)
        expect(b.is_shown("#right"), name == "side", "the second picture in view " + name)
        seen[name] = pixels(b)
    expect(len(set(seen[n] for n in ("side", "slider", "diff", "heat"))), 4, "pictures of the views that differ")
    shown = set()
    b.until(lambda: shown.add(b.text("#what")) or {"golden", "new"} <= shown, "blink shows both")
    b.click("#views [data-view='slider']")
    b.click_at("#left", 0.1)
    wiped = pixels(b)
    b.click_at("#left", 0.9)
    assert pixels(b) != wiped, "the slider moves"
    b.click("#views [data-view='diff']")
    eight = pixels(b)
    b.click("#times option:nth-child(1)")
    b.until(lambda: pixels(b) != eight, "difference times 1 is another picture than times 8")
    assert "times=1" in link(b), link(b)


def zooms_and_reads(b):
    b.open(page + "#frame=8&view=side")
    b.until(lambda: b.script("return document.querySelector('.new').complete"), "pictures are there")
    before = pixels(b), pixels(b, "right")
    b.click("#in")
    after = pixels(b), pixels(b, "right")
    assert before[0] != after[0] and before[1] != after[1], "both pictures zoom"
    assert "zoom=2" in link(b), link(b)
    b.click("#out")
    expect((pixels(b), pixels(b, "right")), before, "zoomed out again")
    b.click("#in")
    b.click("#fit")
    expect(pixels(b), before[0], "the whole again")
    b.hover_at("#left", 0.5)
    assert b.text("#values").startswith("x 1") and ": golden " in b.text("#values"), b.text("#values")


def keys(b):
    b.open(page)
    b.click("h1")
    for key, place in (("home", "0"), ("right", "1"), ("left", "0"), ("end", "8")):
        b.key(key)
        expect(where(b), place, "after the key " + key)
    for key, name in zip("12345", ("side", "slider", "blink", "diff", "heat")):
        b.key(key)
        expect(view(b), [name], "the view after the key " + key)
    b.key("4")
    b.key("]")
    assert "times=16" in link(b), link(b)
    b.key("[")
    assert "times=8" in link(b), link(b)
    b.key("+")
    assert "zoom=2" in link(b), link(b)
    b.key("0")
    assert "zoom" not in link(b), link(b)


def links(b):
    b.open("about:blank")
    b.open(page + "#frame=7&view=diff&times=32&zoom=4&at=0.25,0.75")
    expect(where(b), "7", "the frame of the link")
    expect(view(b), ["diff"], "the view of the link")
    b.key("]")
    assert all(part in link(b) for part in ("frame=7", "view=diff", "times=64", "zoom=4", "at=0.2500,0.7500")), link(b)


def needs_nothing_else(b):
    for file in (bad, good):
        b.open(file.as_uri())
        expect(b.script("return performance.getEntriesByType('resource').map(e => e.name).filter(n => !n.startsWith('data:'))"), [], "files asked for")
        assert file.stat().st_size < 10_000_000, "%s is too large" % file
    expect(b.is_shown(".good"), True, "that it passes")
    b.open(assets.as_uri())
    expect(b.script("return document.querySelectorAll('style, script:not([src]), [style]:not(.now)').length"), 0, "inline styles and scripts")
    b.click("#next")
    b.click("#views [data-view='diff']")
    expect(view(b), ["diff"], "the view with files beside the page")
    expect([c for c in b.console() if "favicon" not in c], [], "complaints of the browser")


with Browser() as browser:
    for part in (steps, views, zooms_and_reads, keys, links, needs_nothing_else):
        part(browser)
        print("ok", part.__name__)
for width in (390, 320):
    with Browser(phone=width) as browser:
        for file in (bad, good, assets):
            browser.open(file.as_uri())
            wide = browser.script("return document.documentElement.scrollWidth")
            assert wide <= width, "%s is %d wide on a phone of %d" % (file, wide, width)
        print("ok on a phone of", width)
with Browser(javascript=False) as browser:
    browser.open(page)
    assert browser.is_shown(".why") and browser.is_shown(".frame .heat") and browser.is_shown(".commands"), "reads without JavaScript"
    assert not browser.is_shown("#viewer"), "no controls without JavaScript"
    print("ok without JavaScript")
