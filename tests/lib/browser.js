// Serves a folder on the loopback, opens a page of it in headless Chromium, and answers as a listener would: presses Start, moves sliders, waits until
// sounds are over, presses the first button that can be pressed. Prints the table of answers that the page gives, then what could not be fetched.
//     node browser.js CHROMIUM FOLDER 'index.html?list=p1' [SCRIPT]     SCRIPT: JavaScript to put behind the page's own
const http = require('http'), fs = require('fs'), path = require('path'), {spawn} = require('child_process');
const [chromium, folder, page, own] = process.argv.slice(2);
const types = {'.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wav': 'audio/wav', '.yaml': 'text/yaml'};
const listener = `
<script>
addEventListener('error', e => fetch('/failed', {method: 'POST', body: String(e.message)}), true);
addEventListener('load', () => {
  const keep = save;
  save = all => fetch('/done', {method: 'POST', body: keep(all)});
  let heard = 0;
  setInterval(() => {
    document.querySelectorAll('audio').forEach(a => {
      if (!a.begun) { a.begun = true; a.muted = true; a.playbackRate = 4; a.play().catch(() => a.begun = false); }
      else if (a.paused && !a.ended && [...document.querySelectorAll('audio')].every(o => o.paused)) a.play().catch(() => {});
    });
    document.querySelectorAll('input[type=range]').forEach((s, k) => {
      if (s.moved) return;
      s.moved = true; s.value = 10 + 20 * k;
      for (const event of ['mousedown', 'pointerdown', 'input', 'change']) s.dispatchEvent(new Event(event, {bubbles: true}));
    });
    const audio = [...document.querySelectorAll('audio')];
    const b = [...document.querySelectorAll('button, input[type=submit]')].find(b => !b.disabled);
    const place = what => what.getBoundingClientRect(), q = [...document.querySelectorAll('p')].find(p => p.textContent === study.question);
    if (q && b && place(q).top > place(b).top) fetch('/failed', {method: 'POST', body: 'the question stands below the answers'});
    if (q && Math.abs(place(q).left + place(q).right - innerWidth) > 20) fetch('/failed', {method: 'POST', body: 'the page is not centred'});
    if (b && audio.every(a => a.ended)) b.click();
    else if (b) fetch('/failed', {method: 'POST', body: 'answers are taken before all is heard'});
  }, 100);
});
</script>`;
const failed = [];
const profile = fs.mkdtempSync(path.join(process.cwd(), 'browser-'));
let child;
const end = code => {
  failed.forEach(f => console.log('failed: ' + f));
  child.on('exit', () => process.exit(code));
  process.kill(-child.pid, 'SIGKILL'); // with all of its own
};
const server = http.createServer((request, response) => {
  const name = decodeURIComponent(new URL(request.url, 'http://x').pathname);
  if (request.method === 'POST') {
    let body = '';
    request.on('data', d => body += d);
    request.on('end', () => {
      response.end();
      if (name === '/failed') failed.push(body);
      else { process.stdout.write(body); end(0); }
    });
    return;
  }
  const file = path.join(folder, name);
  if (!fs.existsSync(file) || fs.statSync(file).isDirectory()) {
    if (name !== '/favicon.ico') failed.push(name);
    response.writeHead(404).end();
    return;
  }
  response.writeHead(200, {'Content-Type': types[path.extname(file)] || 'application/octet-stream'});
  let data = fs.readFileSync(file);
  if (name.endsWith('index.html')) data = data.toString().replace('</body>', (own || listener) + '</body>');
  response.end(data);
}).listen(0, '127.0.0.1', () => {
  child = spawn(chromium, ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--mute-audio', '--no-first-run',
    '--autoplay-policy=no-user-gesture-required', '--user-data-dir=' + profile,
    `http://127.0.0.1:${server.address().port}/${page}`], {stdio: 'ignore', detached: true});
  setTimeout(() => { console.log('no answers in time'); end(1); }, 90000);
});
