// SPDX-License-Identifier: Apache-2.0
"use strict";
// Each event contains the changed sections by their ids; the first event of a connection contains all sections.
(() => {
  const address = document.currentScript.dataset.events;
  const link = document.getElementById("link");
  const AGAIN_MS = 3000;
  function follow() {
    const source = new EventSource(address);
    source.onopen = () => { link.textContent = ""; };
    source.onmessage = (event) => {
      for (const [id, html] of Object.entries(JSON.parse(event.data))) {
        document.getElementById(id).innerHTML = html;
      }
    };
    source.onerror = () => {
      link.textContent = "The server is not heard; what is shown is as old as that. It is asked again.";
      // The browser reconnects to an unavailable server, but not after an error response.
      if (source.readyState === EventSource.CLOSED) { setTimeout(follow, AGAIN_MS); }
    };
  }
  follow();
})();
