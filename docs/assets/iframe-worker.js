// Browsers start no workers for pages that are read from a folder. The search needs one: an iframe does its work there.
if (location.protocol === "file:") {
  window.Worker = class extends EventTarget {
    constructor(url) {
      super()
      const frame = document.createElement("iframe")
      frame.hidden = true
      document.body.append(frame)
      const inner = frame.contentWindow
      this.ready = new Promise(resolve => { inner.started = resolve })
      this.inner = inner
      inner.document.open()
      inner.document.write(
        "<script>postMessage = data => parent.postMessage(data, '*')</script>" +
        `<script src="${encodeURI(decodeURI(url))}"></script><script>started()</script>`)
      inner.document.close()
      window.addEventListener("message", event => {
        if (event.source !== inner) return
        event.stopImmediatePropagation()
        this.dispatchEvent(new MessageEvent("message", {data: event.data}))
      })
    }

    postMessage(data) {
      this.ready.then(() => this.inner.dispatchEvent(new MessageEvent("message", {data})))
    }
  }
}
