"""Layers of a PDF: optional content groups, which readers list and let one show or hide (ISO 32000-1, 8.11)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from .layers import Layer

if TYPE_CHECKING:
    from reportlab.pdfbase.pdfdoc import PDFDictionary, PDFResourceDictionary
    from reportlab.pdfgen.canvas import Canvas


class DocumentLayers:
    """The layers of one document: its pages name them as resources, its catalog says which are shown at first."""

    def __init__(self, canvas: Canvas, language: str) -> None:
        self.document = canvas._doc
        self.language = language
        self.groups: dict[Layer, PDFDictionary] = {}

    def resources(self, layers: Iterable[Layer]) -> PDFResourceDictionary:
        """Return the resources of a page or form on which these layers are."""
        from reportlab.pdfbase.pdfdoc import PDFResourceDictionary

        found = PDFResourceDictionary(Properties={layer.value: self._reference(layer) for layer in layers})
        found.basicFonts()
        return found

    def close(self) -> None:
        """Tell the catalog of the layers of all pages, if there are any."""
        from reportlab.pdfbase.pdfdoc import PDFArray, PDFDictionary

        if not self.groups:
            return
        listed = [layer for layer in Layer if layer in self.groups]
        hidden = PDFArray([self._reference(layer) for layer in listed if layer.hidden])
        groups = PDFArray([self._reference(layer) for layer in listed])
        catalog = self.document.Catalog
        catalog.__NoDefault__ = [*catalog.__NoDefault__, "OCProperties"]  # it writes the entries that it lists
        catalog.OCProperties = PDFDictionary({"OCGs": groups, "D": PDFDictionary({"Order": groups, "OFF": hidden})})

    def _reference(self, layer: Layer) -> object:
        from reportlab.pdfbase.pdfdoc import PDFDictionary, PDFName, PDFString

        if layer not in self.groups:
            title = PDFString(layer.title(self.language))
            self.groups[layer] = PDFDictionary({"Type": PDFName("OCG"), "Name": title})
        return self.document.Reference(self.groups[layer], f"layer-{layer.value}")


def opened(layer: Layer) -> str:
    """Return the operator after which all is in a layer, up to its `EMC`."""
    return f"/OC /{layer.value} BDC"
