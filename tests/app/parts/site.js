// site.js FOLDER: a visitor walks through the pages on a screen and on a phone.
'use strict';
const assert = require('assert'), path = require('path');
const { browse, cutTexts, barriers } = require('./browser.js');
const folder = path.resolve(process.argv[2]);
const address = page => `file://${folder}/${page}`;

browse(async (page, size) => {
    const good = async name => {
        assert.deepStrictEqual(await cutTexts(page), [], `${name} on a ${size}`);
        assert.deepStrictEqual(await barriers(page), [], `${name} on a ${size}`);
        const broken = await page.evaluate(() => [...document.images].filter(image => {
            image.loading = 'eager';
            return image.complete && image.naturalWidth === 0;
        }).map(image => image.src));
        assert.deepStrictEqual(broken, [], name);
    };
    await page.goto(address('index.html'));
    assert.ok((await page.getAttribute('meta[name=description]', 'content')).startsWith('kaya is an open'), 'no description');
    assert.ok(await page.locator('.gallery img').count() >= 9);
    await good('the first page');
    await page.click('.gallery a >> nth=1');
    await page.waitForURL('**/examples/rock-slope/README.html');
    await good('an example');
    // The menu: beside the page, or behind a button.
    if (size === 'phone') await page.click('[data-toggle="wy-nav-top"].fa-bars');
    await page.locator('.wy-menu-vertical a', { hasText: 'A rocking block' }).click();
    await page.waitForURL('**/topics/rocking-block.html');
    await good('a topic');
    if (size === 'phone') await page.click('[data-toggle="wy-nav-top"].fa-bars');
    await page.fill('#rtd-search-form input[name=q]', 'jset');
    await page.keyboard.press('Enter');
    await page.locator('#search-results a', { hasText: 'jset' }).first().click();
    await page.waitForURL('**/commands/jset.html*');
    await good('a command');
    // All columns of tables are seen without scrolling; on a phone up to six.
    for (const name of ['docs/commands/jset', 'docs/joint-models/barton-bandis', 'docs/from-3dec', 'docs/packages', 'docs/modes']) {
        await page.goto(address(`${name}.html`));
        assert.ok((await page.textContent('footer')).includes(`${name}.md`), `${name} does not say its source`);
        const hidden = await page.evaluate(most => [...document.querySelectorAll('.wy-table-responsive')].filter(
            box => box.scrollWidth > box.clientWidth + 1 && box.querySelectorAll('thead th').length <= most).map(box => box.textContent.trim().slice(0, 40)), size === 'screen' ? 99 : 6);
        assert.deepStrictEqual(hidden, [], `tables of ${name} on a ${size}`);
        assert.deepStrictEqual(await cutTexts(page), [], `${name} on a ${size}`);
    }
}).catch(problem => {
    console.log(problem.message);
    process.exit(1);
});
