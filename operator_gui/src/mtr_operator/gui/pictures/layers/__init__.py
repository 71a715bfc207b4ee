"""What a picture consists of; each layer paints one kind of thing."""
# SPDX-License-Identifier: Apache-2.0
