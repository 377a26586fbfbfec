// The theme's boxes with a scroll bar are reached by keyboard, and its captions have their level; after the theme has wrapped tables.
addEventListener('load', () => {
    for (const box of document.querySelectorAll('.highlight pre, pre.literal-block, .wy-table-responsive')) if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
    for (const caption of document.querySelectorAll('[role="heading"]:not([aria-level])')) caption.setAttribute('aria-level', '2');
});
