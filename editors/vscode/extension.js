// @ts-check
// Starts `kaya lsp` for decks. What it knows comes from the program, so that a newer kaya needs no newer extension.
'use strict';
const vscode = require('vscode');
const { LanguageClient } = require('vscode-languageclient/node');

/** @type {LanguageClient | undefined} */
let client;
/** Starts and stops run in order. @type {Promise<void>} */
let last = Promise.resolve();

/** @returns {LanguageClient} */
function newClient() {
    const settings = vscode.workspace.getConfiguration('kaya');
    const folder = vscode.workspace.workspaceFolders?.[0]?.uri.fsPath;
    return new LanguageClient(
        'kaya', 'kaya',
        // The server reads files of the folder where it is started and below.
        { command: settings.get('path', 'kaya'), args: ['lsp'], options: folder === undefined ? {} : { cwd: folder } },
        {
            documentSelector: [{ language: 'kaya', scheme: 'file' }, { language: 'kaya', scheme: 'untitled' }],
            initializationOptions: { dialect: settings.get('dialect', 'both') },
        });
}

async function stop() {
    const running = client;
    client = undefined;
    await running?.stop().catch(() => undefined); // a server that has ended by itself
}

/** @param {string} message */
async function refused(message) {
    const answer = await vscode.window.showErrorMessage(message, 'Open settings');
    if (answer) await vscode.commands.executeCommand('workbench.action.openSettings', 'kaya.path');
}

async function start() {
    client = newClient();
    try {
        await client.start();
    } catch (problem) {
        client = undefined;
        const said = problem instanceof Error ? problem.message : String(problem);
        void refused(`kaya lsp does not start: ${said}. Install kaya, or set kaya.path to the program.`);
    }
}

/** @param {() => Promise<void>} step */
function then(step) {
    last = last.then(step);
    return last;
}

/** @param {vscode.ExtensionContext} context */
function activate(context) {
    const restart = () => then(async () => {
        await stop();
        await start();
    });
    context.subscriptions.push(
        vscode.commands.registerCommand('kaya.restart', restart),
        vscode.workspace.onDidChangeConfiguration(change => { if (change.affectsConfiguration('kaya')) void restart(); }));
    return then(start);
}

function deactivate() {
    return then(stop);
}

module.exports = { activate, deactivate };
