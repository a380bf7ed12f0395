"""Where wishes become commands and values reach the views: the only place that knows both."""
