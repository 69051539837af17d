// node in_chromium.mjs CHROMIUM ADDRESS PROFILE < SCRIPT
// Prints the JSON of a function body that runs in a page of the viewer once it is drawn.
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';

const [program, address, profile] = process.argv.slice(2), script = readFileSync(0, 'utf8');
const chromium = spawn(program, ['--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-dev-shm-usage',
  '--window-size=900,700', '--user-data-dir=' + profile, '--remote-debugging-pipe', 'about:blank'], { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
const waiting = new Map();
let text = '';
chromium.stdio[4].on('data', more => {
  const messages = (text += more).split('\0');
  text = messages.pop();
  for (const message of messages.map(JSON.parse)) if (waiting.has(message.id)) waiting.get(message.id)(message);
});
const send = (method, params, sessionId) => new Promise(done => {
  waiting.set(waiting.size + 1, done);
  chromium.stdio[3].write(JSON.stringify({ id: waiting.size, method, params, sessionId }) + '\0');
});
const { result: { targetId } } = await send('Target.createTarget', { url: address });
const { result: { sessionId } } = await send('Target.attachToTarget', { targetId, flatten: true });
const evaluate = async expression => (await send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true }, sessionId)).result;
const isReady = async () => (await evaluate("document.documentElement.dataset.ready === 'no' || document.documentElement.dataset.ready === 'yes' && typeof contactscope === 'object'"))?.result?.value === true;
while (!await isReady()) await new Promise(done => setTimeout(done, 30));
await evaluate('new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))');
const { result, exceptionDetails } = await evaluate('(() => {' + script + '})()');
process.stdout.write(JSON.stringify(exceptionDetails ? { error: exceptionDetails.exception.description } : result.value), () => {
  chromium.kill();
  process.exit(0);
});
