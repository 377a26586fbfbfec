// What tests of pages share: Debian's chromium without a display by playwright-core, at the sizes of a screen and of a phone.
'use strict';
const path = require('path'), Module = require('module');
const packages = Module.createRequire(path.join(__dirname, '../../../build/browser/node_modules/'));

const sizes = { screen: { width: 1400, height: 900 }, phone: { width: 390, height: 844 } };

/** Calls visit(page, size) at both sizes with a fresh browser; an error in the console of a page, or of its script, fails. */
async function browse(visit) {
    const browser = await packages('playwright-core').chromium.launch({
        executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
    try {
        for (const [size, viewport] of Object.entries(sizes)) {
            const context = await browser.newContext({ viewport, hasTouch: size === 'phone' });
            const page = await context.newPage(), said = [];
            page.on('console', message => { if (['error', 'warning'].includes(message.type()) && !message.text().includes('GPU stall')) said.push(message.text()); });
            page.on('pageerror', problem => said.push(String(problem)));
            await visit(page, size);
            if (said.length) throw new Error(`${size}: the console says ${said.join('; ')}`);
            await context.close();
        }
    } finally {
        await browser.close();
    }
}

/** Texts that do not fit: wider than the window, or than a box that hides the rest and cannot be scrolled. */
function cutTexts(page) {
    return page.evaluate(() => {
        const cut = [], shown = element => element.checkVisibility({ checkOpacity: true, checkVisibilityCSS: true });
        const scrolls = element => {
            for (let box = element; box && box !== document.body; box = box.parentElement)
                if (['auto', 'scroll'].includes(getComputedStyle(box).overflowX)) return true;
            return false;
        };
        const clips = element => ['hidden', 'clip'].includes(getComputedStyle(element).overflowX);
        for (const element of document.body.querySelectorAll('*')) {
            const own = [...element.childNodes].some(node => node.nodeType === Node.TEXT_NODE && node.textContent.trim());
            if (!own || !shown(element) || element.closest('svg, select, .visually-hidden') || scrolls(element)) continue;
            const range = document.createRange();
            range.selectNodeContents(element);
            const text = range.getBoundingClientRect();
            if (text.width < 2 || text.height < 2) continue;
            let limit = document.documentElement.clientWidth;
            for (let box = element; box && box !== document.body; box = box.parentElement)
                if (clips(box)) limit = Math.min(limit, box.getBoundingClientRect().right);
            if (text.right > limit + 1) cut.push(`${element.tagName.toLowerCase()} "${element.textContent.trim().slice(0, 60)}" ends at ${Math.round(text.right)} of ${Math.round(limit)}`);
        }
        const wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
        if (wide > 1) cut.push(`the page is ${wide} pixels wider than the window`);
        return cut;
    });
}

/** What axe-core finds against WCAG 2.1 A and AA. */
async function barriers(page) {
    await page.addScriptTag({ path: packages.resolve('axe-core/axe.min.js') });
    return page.evaluate(async () => (await globalThis.axe.run(document, { preload: false, runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa'] })).violations.map(
        rule => `${rule.id} (${rule.nodes.length}): ${rule.nodes.slice(0, 3).map(node => `${node.target.join(' ')} ${(node.any[0] || node.all[0] || {}).message || ''}`).join(' | ')}`));
}

module.exports = { browse, cutTexts, barriers };
