// extension.js EXTENSION PROGRAM FOLDER: activates the packed extension with a stand-in for Visual Studio Code, takes the server that it
// starts, and speaks to it with the client's own protocol modules.
'use strict';
const assert = require('assert'), fs = require('fs'), path = require('path'), Module = require('module');
const { spawn } = require('child_process'), { pathToFileURL } = require('url');
const [extension, program, folder] = process.argv.slice(2);
const packages = Module.createRequire(path.join(extension, 'extension.js'));

// What the extension sees of the editor.
const settings = { path: program, dialect: 'modern' };
const started = [], shown = [], commands = {}, listeners = [];
let refuses = false, stopped = 0;
class Client {
    constructor(id, name, server, options) { Object.assign(this, { id, server, options }); }
    async start() {
        if (refuses) throw new Error('spawn ENOENT');
        started.push(this);
    }
    async stop() { ++stopped; }
}
const editor = {
    workspace: {
        workspaceFolders: [{ uri: { fsPath: folder } }],
        getConfiguration: section => ({ get: (name, otherwise) => section === 'kaya' ? settings[name] ?? otherwise : otherwise }),
        onDidChangeConfiguration: listener => listeners.push(listener),
    },
    commands: { registerCommand: (name, run) => { commands[name] = run; }, executeCommand: async () => undefined },
    window: { showErrorMessage: async message => { shown.push(message); } },
};
const load = Module._load;
Module._load = (name, ...more) => name === 'vscode' ? editor : name === 'vscode-languageclient/node' ? { LanguageClient: Client } : load(name, ...more);
const kaya = packages('./extension.js');
Module._load = load;

async function settingsAndEnds() {
    await kaya.activate({ subscriptions: [] });
    assert.strictEqual(started.length, 1);
    settings.dialect = 'both';
    listeners.forEach(listener => listener({ affectsConfiguration: section => section === 'kaya' }));
    await commands['kaya.restart']();
    assert.deepStrictEqual(started.map(client => client.options.initializationOptions.dialect), ['modern', 'both', 'both']);
    assert.strictEqual(stopped, 2);
    refuses = true;
    await commands['kaya.restart']();
    assert.ok(shown.length === 1 && shown[0].includes('ENOENT') && shown[0].includes('kaya.path'), shown.join());
    await kaya.deactivate(); // nothing runs
    assert.strictEqual(stopped, 3);
    return started[0];
}

const deck = `def twice(a)
  twice = 2 * a
end
poly brik 0 1 0 1 0 1
poly brick 0 [twice(1)] 0 1 0 1
bl
block create brick 0 1 0 1 0 1
@twice(3)
`;

(async () => {
    const manifest = packages('./package.json');
    const known = Object.keys(manifest.contributes.configuration.properties).map(name => name.replace('kaya.', ''));
    assert.deepStrictEqual(known.sort(), Object.keys(settings).sort());
    const client = await settingsAndEnds();
    const protocol = packages('vscode-languageserver-protocol/node');
    const { command, args, options } = client.server;
    assert.strictEqual(options.cwd, folder);
    const server = spawn(command, args, options);
    const connection = protocol.createProtocolConnection(new protocol.StreamMessageReader(server.stdout), new protocol.StreamMessageWriter(server.stdin));
    const mistakes = new Promise(found => connection.onNotification(protocol.PublishDiagnosticsNotification.type, found));
    connection.listen();
    const ask = (request, parameters) => connection.sendRequest(request.type, parameters);
    const begun = await ask(protocol.InitializeRequest, { processId: process.pid, rootUri: null, capabilities: {}, ...client.options });
    assert.strictEqual(begun.serverInfo.name, 'kaya');
    await connection.sendNotification(protocol.InitializedNotification.type, {});
    const file = path.join(folder, 'wall.3dd');
    fs.writeFileSync(file, deck);
    const uri = pathToFileURL(file).href, textDocument = { uri };
    const { language } = client.options.documentSelector[0];
    assert.strictEqual(language, manifest.contributes.languages[0].id);
    await connection.sendNotification(protocol.DidOpenTextDocumentNotification.type, { textDocument: { uri, languageId: language, version: 1, text: deck } });
    const { diagnostics } = await mistakes;
    const mistake = diagnostics.find(one => one.message.includes('brik'));
    assert.deepStrictEqual(mistake.range.start, { line: 3, character: 5 });
    const at = (line, character) => ({ textDocument, position: { line, character } });
    const words = (await ask(protocol.CompletionRequest, at(5, 2))).items.map(item => item.label);
    assert.ok(words.includes('block') && !words.includes('poly'), words.join());
    const begins = (await ask(protocol.CompletionRequest, at(5, 0))).items.map(item => item.label);
    assert.ok(!begins.includes('poly'), 'the dialect of the settings has no poly');
    assert.ok((await ask(protocol.HoverRequest, at(4, 1))).contents.value.includes('poly'));
    assert.strictEqual((await ask(protocol.DefinitionRequest, at(7, 3))).range.start.line, 0);
    const edits = (await ask(protocol.RenameRequest, { ...at(7, 3), newName: 'double' })).changes[uri];
    assert.strictEqual(edits.length, 4);
    const actions = (line, list) => ask(protocol.CodeActionRequest, { textDocument, range: { start: { line, character: 0 }, end: { line, character: 0 } }, context: { diagnostics: list } });
    assert.strictEqual((await actions(3, [mistake]))[0].edit.changes[uri][0].newText, 'brick');
    const [other] = await actions(6, []);
    assert.ok(other.title.includes('classic') && other.edit.changes[uri][0].newText.startsWith('poly brick'), JSON.stringify(other));
    await ask(protocol.ShutdownRequest);
    await connection.sendNotification(protocol.ExitNotification.type);
    const status = await new Promise(ended => server.on('exit', ended));
    assert.strictEqual(status, 0);
    connection.dispose();
})().catch(problem => {
    console.log(problem);
    process.exit(1);
});
