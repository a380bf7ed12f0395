"""Views of the window itself: the palette, the list of shortcuts, the sentences, the tabs."""
