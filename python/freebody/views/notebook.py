"""A run in a notebook: its report in a frame, which shares its time where anywidget is installed."""

from __future__ import annotations

from functools import cache
from html import escape
from typing import TYPE_CHECKING, Any

from freebody.views.report import report_html

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_LOOK = "width: 100%; border: 1px solid #ccc; border-radius: 6px"
_RENDER = """
function render({ model, el }) {
  const frame = document.createElement("iframe");
  frame.style = `${model.get("look")}; height: ${model.get("height")}px`;
  frame.srcdoc = model.get("page");
  const heard = ({ source, data }) => {
    if (source !== frame.contentWindow || !Number.isFinite(data?.t) || data.t === model.get("t")) return;
    model.set("t", data.t);
    model.save_changes();
  };
  const told = () => frame.contentWindow.postMessage({ t: model.get("t") }, "*");
  window.addEventListener("message", heard);
  model.on("change:t", told);
  el.append(frame);
  return () => window.removeEventListener("message", heard);
}
export default { render };
"""


def player(run: Run, height: int = 640) -> Any:
    """The report of a run, ``height`` pixels high, for a notebook to show. With anywidget it is a widget whose ``t`` is the time of the
    mechanism in s, read, set and observed as that of any widget; without, a page that moves by itself."""
    try:
        widget = _widget()
    except ImportError:
        return _Framed(report_html(run), height)
    return widget(page=report_html(run), height=height, look=_LOOK, t=float(run.t[0]))


class _Framed:
    def __init__(self, page: str, height: int) -> None:
        self.page, self.height = page, height

    def _repr_html_(self) -> str:
        return f'<iframe style="{_LOOK}; height: {self.height}px" srcdoc="{escape(self.page)}"></iframe>'


@cache
def _widget() -> Any:
    """The class of the widget. Raises ``ImportError``."""
    import traitlets
    from anywidget import AnyWidget

    class Player(AnyWidget):  # type: ignore[misc]
        """A run that plays; ``t`` in s is the time of the mechanism."""

        _esm = _RENDER
        page = traitlets.Unicode().tag(sync=True)
        look = traitlets.Unicode().tag(sync=True)
        height = traitlets.Int().tag(sync=True)
        t = traitlets.Float().tag(sync=True)

    return Player
