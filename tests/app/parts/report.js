// report.js PAGE: a reader opens the report of a run on a screen and on a phone: clicks, keys, views, colours.
'use strict';
const assert = require('assert'), path = require('path');
const { browse, cutTexts, barriers } = require('./browser.js');

browse(async (page, size) => {
    await page.goto(`file://${path.resolve(process.argv[2])}`);
    await page.waitForSelector('html[data-state=drawn]');
    const blocks = page.locator('#blocks');
    const box = await blocks.boundingBox();
    // How much of the frame the model covers: the share of its width or height between the first and the last pixel that is drawn.
    const covers = () => blocks.evaluate(canvas => {
        const gl = canvas.getContext('webgl2'), { width, height } = canvas, pixels = new Uint8Array(4 * width * height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        let left = width, right = 0, low = height, high = 0;
        for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x) if (pixels[4 * (y * width + x) + 3]) {
            left = Math.min(left, x); right = Math.max(right, x); low = Math.min(low, y); high = Math.max(high, y);
        }
        return [(right - left) / width, (high - low) / height];
    });
    const frame = () => page.evaluate(() => new Promise(drawn => requestAnimationFrame(() => requestAnimationFrame(drawn))));
    for (const side of ['front', 'top', 'isometric']) {
        await page.click(`#sides button:text-is("${side}")`);
        await frame();
        const [across, up] = await covers();
        assert.ok(across > 0.55 || up > 0.8, `${side} covers ${across} of the width, ${up} of the height`);
        assert.ok(across <= 0.94 && up <= 0.94, `${side} is cut: ${across}, ${up}`);
    }
    // The legend hides nothing of it.
    const legend = await page.locator('#legend').boundingBox();
    const hidden = await blocks.evaluate((canvas, { legend, box }) => {
        const gl = canvas.getContext('webgl2'), pixels = new Uint8Array(4 * canvas.width * canvas.height);
        gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        let count = 0;
        for (let y = 0; y < canvas.height; ++y) for (let x = 0; x < canvas.width; ++x) {
            const right = box.x + x, down = box.y + canvas.height - 1 - y;
            if (right >= legend.x && right < legend.x + legend.width && down >= legend.y && down < legend.y + legend.height && pixels[4 * (y * canvas.width + x) + 3]) ++count;
        }
        return count;
    }, { legend, box });
    assert.strictEqual(hidden, 0, `the legend hides ${hidden} pixels on a ${size}`);
    const click = async () => {
        await blocks.scrollIntoViewIfNeeded();
        const { x, y, width, height } = await blocks.boundingBox();
        return size === 'phone' ? page.touchscreen.tap(x + width / 2, y + height / 2) : page.mouse.click(x + width / 2, y + height / 2);
    };
    await click();
    const picked = () => page.textContent('#picked');
    assert.match(await picked(), /^block \d+\n(.*\n)*displacement: .* length\nvelocity: /);
    assert.deepStrictEqual(await cutTexts(page), [], size);
    assert.deepStrictEqual(await barriers(page), [], size);
    const before = await blocks.screenshot();
    await blocks.focus();
    for (const key of ['ArrowLeft', '+']) await page.keyboard.press(key);
    await frame();
    assert.ok(!before.equals(await blocks.screenshot()), 'keys do not turn the model');
    // Arrows, principal stresses, bands and an oblique cut change the picture.
    let last = await blocks.screenshot();
    const changes = async (what, change) => {
        await change();
        await frame();
        const now = await blocks.screenshot();
        assert.ok(!now.equals(last), `${what} does not change the picture on a ${size}`);
        last = now;
    };
    for (const name of ['displacement', 'velocity', 'contact force', 'principal stress']) {
        await changes(`arrows of ${name}`, () => page.selectOption('#marks', name));
        assert.match(await page.textContent('#legend'), new RegExp(`^${name}`));
    }
    await changes('no arrows', () => page.selectOption('#marks', 'none'));
    await changes('bands', () => page.check('#bands'));
    await changes('a cut', () => page.fill('#cut', '500'));
    assert.ok(await page.isHidden('#dip'), 'a dip is asked for a cut across an axis');
    await changes('a plane', () => page.selectOption('#axis', 'plane'));
    await changes('a dip', () => page.fill('#dip', '35'));
    await changes('a dip direction', () => page.fill('#dd', '200'));
    assert.deepStrictEqual(await cutTexts(page), [], size);
    assert.deepStrictEqual(await barriers(page), [], size);
    await page.fill('#cut', '1000');
    // One surface of equal value, then those of all bands.
    await page.uncheck('#bands');
    await changes('a surface of equal value', () => page.check('#equal'));
    const value = Number(await page.textContent('#level-value'));
    assert.ok(value > 0, `the surface has the value ${value}`);
    await changes('its value', () => page.fill('#level', '800'));
    assert.ok(Number(await page.textContent('#level-value')) > value, 'a slider to the right lowers the value');
    await changes('surfaces of all bands', () => page.check('#bands'));
    assert.ok(await page.isHidden('#level'), 'a value is asked for where bands have theirs');
    assert.deepStrictEqual(await cutTexts(page), [], size);
    assert.deepStrictEqual(await barriers(page), [], size);
    await page.uncheck('#equal');
    await page.selectOption('#what', 'joints');
    await page.waitForFunction(() => [...document.querySelectorAll('#field option')].some(option => option.text === 'joint_set'));
    await page.click('#sides button:text-is("isometric")');
    await frame();
    await click();
    assert.match(await picked(), /^joint \d+\nshear displacement: (.*\n)*normal stress: (.*\n)*state: [a-z]/);
    await page.locator('#course-curves svg').first().hover();
    assert.match(await page.textContent('#course-curves .read >> nth=0'), /^cycle [\d,]+: /);
}).catch(problem => {
    console.log(problem.message);
    process.exit(1);
});
